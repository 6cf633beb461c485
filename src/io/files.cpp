#include "fascicle/io/files.hpp"

#include "fascicle/base/error.hpp"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <unistd.h>

namespace fascicle {
namespace fs = std::filesystem;

namespace {

std::string reason(int number = errno) {
    return number != 0 ? std::strerror(number) : "unknown reason";
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
    const bool written = !stream_.fail();
    errno = 0;
    if (buffer_.close() == nullptr || !written)
        throw_error(path_.string(), "cannot write: " + reason(buffer_.reason != 0 ? buffer_.reason : errno));
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
