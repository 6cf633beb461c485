#include "fascicle/io/files.hpp"

#include "fascicle/base/error.hpp"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <mutex>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace fascicle {
namespace fs = std::filesystem;

namespace {

std::string reason(int number = errno) {
    return number != 0 ? std::strerror(number) : "unknown reason";
}

/// "a folder", "a pipe"; null for a regular file.
const char* kind_of(mode_t mode) {
    return S_ISREG(mode)    ? nullptr
           : S_ISDIR(mode)  ? "a folder"
           : S_ISFIFO(mode) ? "a pipe"
           : S_ISSOCK(mode) ? "a socket"
                            : "a device";
}

/// A regular file open for reading. Nothing else is opened: a pipe would wait for a writer, a device may do anything.
class RegularFile {
public:
    explicit RegularFile(const fs::path& path) {
        if (path.native().find('\0') != std::string::npos) {
            error_ = ENOENT;
            return;
        }
        if (!look(::stat(path.c_str(), &facts_)))
            return;
        number_ = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
        error_ = number_ < 0 ? errno : 0;
        if (number_ >= 0 && !look(::fstat(number_, &facts_))) // another one since the first look
            ::close(std::exchange(number_, -1));
    }
    ~RegularFile() {
        if (number_ >= 0)
            ::close(number_);
    }
    RegularFile(const RegularFile&) = delete;
    RegularFile& operator=(const RegularFile&) = delete;
    int number() const { return number_; } ///< below 0: not open
    int error() const { return error_; }
    bool missing() const { return error_ == ENOENT || error_ == ENOTDIR; }
    const char* kind() const { return kind_; } ///< null: a regular file, or nothing at all
    std::size_t size() const { return number_ < 0 ? 0 : static_cast<std::size_t>(facts_.st_size); }

private:
    bool look(int result) {
        error_ = result != 0 ? errno : 0;
        kind_ = result == 0 ? kind_of(facts_.st_mode) : nullptr;
        return result == 0 && kind_ == nullptr;
    }
    struct stat facts_ = {};
    int number_ = -1, error_ = 0;
    const char* kind_ = nullptr;
};

/// 0, or the system's reason; what cannot be flushed at all (some network folders) counts as done.
int flush_to_disk(int file) {
    int failed = 0;
    do
        failed = ::fsync(file) == 0 ? 0 : errno;
    while (failed == EINTR);
    return failed == EINVAL || failed == ENOTSUP ? 0 : failed;
}

/// How names of temporary files for `path` begin: a number of the program and one of the file follow. A name has 255 bytes at most.
std::string temporary_start(const fs::path& path) {
    return path.filename().string().substr(0, 220) + ".part";
}

/// Folders from `folder` up to `highest`, as far as nothing is in them.
void remove_empty_folders(fs::path folder, const fs::path& highest) {
    while (!highest.empty() && (::rmdir(folder.c_str()) == 0 || errno == ENOENT) && folder != highest)
        folder = folder.parent_path();
}

/// Whether a file's name is `start`, the number of a program that is no longer there, '-' and a number.
bool is_orphan(const std::string& name, const std::string& start) {
    if (name.compare(0, start.size(), start) != 0 || name.size() == start.size() ||
        name.find_first_not_of("0123456789-", start.size()) != std::string::npos)
        return false;
    char* rest = nullptr;
    const long pid = std::strtol(name.c_str() + start.size(), &rest, 10);
    return pid > 0 && *rest == '-' && rest[1] != '\0' &&
           std::strchr(rest + 1, '-') == nullptr && // else the number of something else
           ::kill(static_cast<pid_t>(pid), 0) != 0 && errno == ESRCH;
}

/// Names in a folder that could be temporary files. A run writes thousands of files into one folder: it is listed once in some
/// seconds, not once a file.
class Leftovers {
public:
    std::vector<std::string> of(const fs::path& folder) {
        const std::lock_guard<std::mutex> lock(mutex_);
        const auto now = std::chrono::steady_clock::now();
        if (folder != folder_ || now - listed_ > std::chrono::seconds(5)) {
            names_.clear();
            std::error_code error;
            for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
                if (std::string name = it->path().filename().string();
                    name.find(".part") != std::string::npos)
                    names_.push_back(std::move(name));
            folder_ = folder;
            listed_ = now;
        }
        return names_;
    }

private:
    std::mutex mutex_;
    fs::path folder_;
    std::chrono::steady_clock::time_point listed_;
    std::vector<std::string> names_;
};

/// Removes temporary files of `path` whose program is no longer there. Those of other names stay: they might be somebody's own.
void remove_orphans(const fs::path& path) {
    static Leftovers leftovers;
    std::error_code error;
    const fs::path folder =
        path.has_parent_path() ? fs::absolute(path.parent_path(), error) : fs::current_path(error);
    if (error ||
        folder.filename().native().starts_with(hidden_folder)) // of this run, so that nothing is left in it
        return;
    const std::string start = temporary_start(path);
    for (const std::string& name : leftovers.of(folder))
        if (is_orphan(name, start))
            fs::remove(folder / name, error);
}

} // namespace

std::string read_file(const fs::path& path, std::size_t max_bytes) {
    const auto fail = [&](const std::string& what) { throw_error(path.string(), "cannot read: " + what); };
    const RegularFile file(path);
    if (file.missing())
        fail("no such file");
    if (file.kind() != nullptr)
        throw_error(path.string(), std::string("cannot read: is ") + file.kind(), "a file");
    if (file.number() < 0)
        fail(reason(file.error()));
    const auto too_large = [&] {
        throw_error(path.string(), "file is too large", "at most " + std::to_string(max_bytes) + " bytes");
    };
    if (file.size() > max_bytes)
        too_large();
    std::string bytes;
    try {
        bytes.reserve(file.size()); // a promise only: a file may grow, and some tell 0
        char block[1 << 16];
        for (;;) {
            const ssize_t n = ::read(file.number(), block, sizeof block);
            if (n < 0 && errno == EINTR)
                continue;
            if (n < 0)
                fail(reason());
            if (n == 0)
                return bytes;
            bytes.append(block, static_cast<std::size_t>(n));
            if (bytes.size() > max_bytes)
                too_large();
        }
    } catch (const std::bad_alloc&) {
        fail("not enough memory for " + std::to_string(std::max(file.size(), bytes.size())) + " bytes");
    }
    return bytes;
}

std::string read_head(const fs::path& path, std::size_t bytes) {
    const RegularFile file(path);
    std::string head(file.number() < 0 ? 0 : bytes, '\0');
    std::size_t done = 0;
    while (done < head.size()) {
        const ssize_t n = ::read(file.number(), head.data() + done, head.size() - done);
        if (n < 0 && errno == EINTR)
            continue;
        if (n <= 0)
            break;
        done += static_cast<std::size_t>(n);
    }
    head.resize(done);
    return head;
}

void check_output_name(const fs::path& path) {
    struct stat facts = {};
    if (path.filename().empty())
        throw_error(path.string(), "cannot write: names a folder", "the name of a file");
    if (path.native().find('\0') != std::string::npos)
        throw_error(path.string(), "cannot write: a zero byte in the name", "the name of a file");
    if (::stat(path.c_str(), &facts) == 0 && !S_ISREG(facts.st_mode))
        throw_error(path.string(), std::string("cannot write: is ") + kind_of(facts.st_mode),
                    "the name of a file");
}

std::string shown_path(const fs::path& path) {
    fs::path shown;
    for (const fs::path& part : path)
        if (!part.native().starts_with(hidden_folder))
            shown /= part;
    return shown.string();
}

MadeFolders::MadeFolders(fs::path folder) : folder_(std::move(folder)) {
    std::error_code error;
    for (fs::path path = folder_; fs::status(path, error).type() == fs::file_type::not_found && !path.empty();
         path = path.parent_path())
        made_ = path;
    error.clear();
    if (!folder_.empty())
        fs::create_directories(folder_, error);
    if (!error)
        return;
    remove_empty_folders(folder_, made_);
    throw_error(shown_path(folder_), "cannot create the folder: " + error.message());
}

MadeFolders::~MadeFolders() {
    remove_empty_folders(folder_, made_);
}

AtomicFile::Buffer::Buffer() : block_(std::size_t{1} << 16) {
    setp(block_.data(), block_.data() + block_.size());
}

bool AtomicFile::Buffer::put(const char* data, std::size_t size) {
    while (size > 0 && reason == 0) {
        const ssize_t n = ::write(file, data, size);
        if (n >= 0) { // less than asked for is no failure yet: the next one tells why
            data += n;
            size -= static_cast<std::size_t>(n);
        } else if (errno != EINTR) {
            reason = errno;
        }
    }
    return reason == 0;
}

int AtomicFile::Buffer::sync() {
    const bool good = put(pbase(), static_cast<std::size_t>(pptr() - pbase()));
    setp(block_.data(), block_.data() + block_.size());
    return good ? 0 : -1;
}

AtomicFile::Buffer::int_type AtomicFile::Buffer::overflow(int_type c) {
    if (sync() != 0)
        return traits_type::eof();
    if (!traits_type::eq_int_type(c, traits_type::eof()))
        sputc(traits_type::to_char_type(c));
    return traits_type::not_eof(c);
}

std::streamsize AtomicFile::Buffer::xsputn(const char* data, std::streamsize size) {
    if (size < epptr() - pptr()) {
        std::memcpy(pptr(), data, static_cast<std::size_t>(size));
        pbump(static_cast<int>(size));
        return size;
    }
    return sync() == 0 && put(data, static_cast<std::size_t>(size)) ? size : 0;
}

void AtomicFile::Buffer::close() {
    // Linux frees the number even when it tells EINTR; what else it tells (network folders) is that bytes were lost.
    if (file >= 0 && ::close(std::exchange(file, -1)) != 0 && errno != EINTR && reason == 0)
        reason = errno;
}

fs::path temporary_name(const fs::path& path) {
    static std::atomic<unsigned> counter{0};
    remove_orphans(path);
    return path.parent_path() /
           (temporary_start(path) + std::to_string(::getpid()) + "-" + std::to_string(counter++));
}

AtomicFile::AtomicFile(fs::path path)
    : path_((check_output_name(path), std::move(path))), folders_(path_.parent_path()) {
    // Never a file or link that somebody else put there: a number that is taken is passed over.
    for (int attempt = 0; attempt < 100 && buffer_.file < 0; ++attempt) {
        temporary_ = temporary_name(path_);
        do
            buffer_.file = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        while (buffer_.file < 0 && errno == EINTR);
        if (buffer_.file < 0 && errno != EEXIST)
            break;
    }
    if (buffer_.file < 0)
        throw_error(shown_path(path_), "cannot write: " + reason());
}

AtomicFile::~AtomicFile() {
    if (temporary_.empty())
        return;
    buffer_.close();
    std::error_code ignored;
    fs::remove(temporary_, ignored);
}

void AtomicFile::write(const void* data, std::size_t size) {
    stream_.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
}

void AtomicFile::commit() {
    commit(Flush::no);
}

void AtomicFile::commit(Flush flush) {
    stream_.flush();
    if (flush == Flush::to_disk && buffer_.reason == 0)
        buffer_.reason = flush_to_disk(buffer_.file);
    buffer_.close();
    if (buffer_.reason != 0 || stream_.fail())
        throw_error(shown_path(path_), "cannot write: " + reason(buffer_.reason));
    std::error_code code;
    fs::rename(temporary_, path_, code);
    if (code)
        throw_error(shown_path(path_), "cannot write: " + code.message());
    temporary_.clear();
    folders_.keep();
    if (flush == Flush::no)
        return;
    // The file is whole under its name already: a folder that cannot be flushed is no failure.
    const fs::path folder = path_.has_parent_path() ? path_.parent_path() : fs::path(".");
    if (const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); file >= 0) {
        flush_to_disk(file);
        ::close(file);
    }
}

void write_file(const fs::path& path, const std::string& bytes) {
    AtomicFile file(path);
    file.write(bytes.data(), bytes.size());
    file.commit();
}

void write_document(const fs::path& path, const std::string& bytes) {
    std::error_code error;
    const fs::path absolute = fs::absolute(path, error);
    fs::path target = fs::weakly_canonical(absolute, error);
    if (error)
        target = absolute;
    const fs::file_status old = fs::status(target, error);
    if (fs::is_directory(old))
        throw_error(path.string(), "cannot write: is a folder", "the name of a file");
    if (fs::exists(old) && ::access(target.c_str(), W_OK) != 0)
        throw_error(path.string(), "cannot write: " + reason());
    AtomicFile file(target);
    file.write(bytes.data(), bytes.size());
    file.commit(AtomicFile::Flush::to_disk);
    if (fs::exists(old))
        fs::permissions(target, old.permissions(), error);
}

} // namespace fascicle
