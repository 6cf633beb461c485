#pragma once
// Whole files in, whole files out. A file under its final name is always complete.

#include <filesystem>
#include <fstream>
#include <string>

namespace fascicle {

/// Reads a whole file. Error naming the file and the system's reason when it cannot be read, is a folder, or
/// is larger than `max_bytes`.
std::string read_file(const std::filesystem::path& path, std::size_t max_bytes = std::size_t{4} << 30);

/// Writes to a temporary file in the same folder; commit() flushes, checks and renames it to `path`.
/// Without commit() the destructor removes it: no half-written file is left under a final name.
class AtomicFile {
public:
    /// Creates missing parent folders. Error naming the file and the system's reason.
    explicit AtomicFile(std::filesystem::path path);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    std::ostream& stream() { return stream_; }
    void write(const void* data, std::size_t size);
    /// Error naming the file when writing failed (disk full, folder gone).
    void commit();
    /// to_disk: the bytes are on the disk before the file gets its name, and the name before this returns, so that a power
    /// cut leaves the old file or the new one.
    enum class Flush { no, to_disk };
    void commit(Flush flush);

private:
    /// Remembers the system's reason of the first write that failed: by the time of commit() errno is another's.
    class Buffer : public std::filebuf {
    public:
        int reason = 0;

    protected:
        int_type overflow(int_type c) override;
        std::streamsize xsputn(const char* data, std::streamsize size) override;
        int sync() override;
    };

    std::filesystem::path path_;
    std::filesystem::path temporary_;
    Buffer buffer_;
    std::ostream stream_{&buffer_};
};

/// AtomicFile for text or bytes that are already in memory.
void write_file(const std::filesystem::path& path, const std::string& bytes);

/// The same for a document of the user's, flushed to the disk: what a link points to is replaced, not the link; permissions
/// stay; a write-protected file is an Error; temporary files that a crashed program left beside it are removed.
void write_document(const std::filesystem::path& path, const std::string& bytes);

} // namespace fascicle
