#include "fascicle/io/files.hpp"

#include "fascicle/base/error.hpp"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

namespace fascicle {
namespace fs = std::filesystem;

namespace {

std::string reason(int number = errno) {
    return number != 0 ? std::strerror(number) : "unknown reason";
}

/// What was written through any handle reaches the disk. 0, or the system's reason; what cannot be flushed at all (some
/// network folders) counts as done.
int flush_to_disk(const fs::path& path, int flags) {
    const int file = ::open(path.c_str(), flags | O_CLOEXEC);
    if (file < 0)
        return errno;
    const int failed = ::fsync(file) == 0 ? 0 : errno;
    ::close(file);
    return failed == EINVAL || failed == ENOTSUP ? 0 : failed;
}

/// Temporary files of `path` whose program is no longer there.
void remove_orphans(const fs::path& path) {
    const std::string start = path.filename().string() + ".part";
    std::error_code error;
    for (fs::directory_iterator it(path.parent_path(), error), end; !error && it != end;
         it.increment(error)) {
        const std::string name = it->path().filename().string();
        if (name.compare(0, start.size(), start) != 0)
            continue;
        char* rest = nullptr;
        const long pid = std::strtol(name.c_str() + start.size(), &rest, 10);
        std::error_code ignored;
        if (pid > 0 && *rest == '-' && ::kill(static_cast<pid_t>(pid), 0) != 0 && errno == ESRCH)
            fs::remove(it->path(), ignored);
    }
}

} // namespace

std::string read_file(const fs::path& path, std::size_t max_bytes) {
    std::error_code code;
    const fs::file_status status = fs::status(path, code);
    if (!fs::exists(status))
        throw_error(path.string(), "cannot read: no such file");
    if (fs::is_directory(status))
        throw_error(path.string(), "cannot read: is a folder", "a file");
    errno = 0;
    std::ifstream stream(path, std::ios::binary);
    if (!stream)
        throw_error(path.string(), "cannot read: " + reason());
    std::string bytes;
    if (fs::is_regular_file(status)) // a promise only: a file may grow, and some tell 0
        if (const std::uintmax_t size = fs::file_size(path, code); !code)
            bytes.reserve(static_cast<std::size_t>(std::min<std::uintmax_t>(size, max_bytes)));
    char block[1 << 16];
    while (stream.read(block, sizeof block) || stream.gcount() > 0) {
        bytes.append(block, static_cast<std::size_t>(stream.gcount()));
        if (bytes.size() > max_bytes)
            throw_error(path.string(), "file is too large",
                        "at most " + std::to_string(max_bytes) + " bytes");
    }
    if (stream.bad())
        throw_error(path.string(), "cannot read: " + reason());
    return bytes;
}

AtomicFile::Buffer::int_type AtomicFile::Buffer::overflow(int_type c) {
    errno = 0;
    const int_type result = std::filebuf::overflow(c);
    if (traits_type::eq_int_type(result, traits_type::eof()) && reason == 0)
        reason = errno;
    return result;
}

std::streamsize AtomicFile::Buffer::xsputn(const char* data, std::streamsize size) {
    errno = 0;
    const std::streamsize written = std::filebuf::xsputn(data, size);
    if (written != size && reason == 0)
        reason = errno;
    return written;
}

int AtomicFile::Buffer::sync() {
    errno = 0;
    const int result = std::filebuf::sync();
    if (result != 0 && reason == 0)
        reason = errno;
    return result;
}

AtomicFile::AtomicFile(fs::path path) : path_(std::move(path)) {
    static std::atomic<unsigned> counter{0};
    std::error_code code;
    if (path_.has_parent_path())
        fs::create_directories(path_.parent_path(), code);
    if (code)
        throw_error(path_.parent_path().string(), "cannot create the folder: " + code.message());
    temporary_ = path_;
    temporary_ += ".part" + std::to_string(::getpid()) + "-" + std::to_string(counter++);
    errno = 0;
    if (buffer_.open(temporary_, std::ios::out | std::ios::binary | std::ios::trunc) == nullptr)
        throw_error(path_.string(), "cannot write: " + reason());
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
    const bool written = !stream_.fail();
    errno = 0;
    if (buffer_.close() == nullptr || !written)
        throw_error(path_.string(), "cannot write: " + reason(buffer_.reason != 0 ? buffer_.reason : errno));
    if (flush == Flush::to_disk)
        if (const int failed = flush_to_disk(temporary_, O_RDONLY); failed != 0)
            throw_error(path_.string(), "cannot write: " + reason(failed));
    std::error_code code;
    fs::rename(temporary_, path_, code);
    if (code)
        throw_error(path_.string(), "cannot write: " + code.message());
    temporary_.clear();
    if (flush ==
        Flush::
            to_disk) // the file is whole under its name already: a folder that cannot be flushed is no failure
        flush_to_disk(path_.has_parent_path() ? path_.parent_path() : fs::path("."), O_RDONLY | O_DIRECTORY);
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
    remove_orphans(target);
}

} // namespace fascicle
