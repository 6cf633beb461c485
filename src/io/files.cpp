#include "fascicle/io/files.hpp"

#include "fascicle/base/error.hpp"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <unistd.h>

namespace fascicle {
namespace fs = std::filesystem;

namespace {

std::string reason() {
    return errno != 0 ? std::strerror(errno) : "unknown reason";
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
    stream_.open(temporary_, std::ios::binary | std::ios::trunc);
    if (!stream_)
        throw_error(path_.string(), "cannot write: " + reason());
}

AtomicFile::~AtomicFile() {
    if (temporary_.empty())
        return;
    stream_.close();
    std::error_code ignored;
    fs::remove(temporary_, ignored);
}

void AtomicFile::write(const void* data, std::size_t size) {
    stream_.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
}

void AtomicFile::commit() {
    errno = 0;
    stream_.close();
    if (stream_.fail())
        throw_error(path_.string(), "cannot write: " + reason());
    std::error_code code;
    fs::rename(temporary_, path_, code);
    if (code)
        throw_error(path_.string(), "cannot write: " + code.message());
    temporary_.clear();
}

void write_file(const fs::path& path, const std::string& bytes) {
    AtomicFile file(path);
    file.write(bytes.data(), bytes.size());
    file.commit();
}

} // namespace fascicle
