#pragma once
// Whole files in, whole files out. A file under its final name is always complete.

#include <filesystem>
#include <ostream>
#include <streambuf>
#include <string>
#include <vector>

namespace fascicle {

/// Reads a whole file. Error naming the file and the system's reason when it cannot be read, is a folder, or
/// is larger than `max_bytes`. Pipes, devices and sockets are refused at once: they could wait or go on for ever.
std::string read_file(const std::filesystem::path& path, std::size_t max_bytes = std::size_t{4} << 30);

/// The first `bytes` of a file, fewer where it ends; empty when it cannot be read or is no regular file.
std::string read_head(const std::filesystem::path& path, std::size_t bytes);

/// Error when a file of this name could not be put in place for what is there now: a folder, or a pipe, device or socket, which a
/// file would replace. For commands to ask before they work.
void check_output_name(const std::filesystem::path& path);

/// Hidden folders that files are written into before they get their final names begin with this (staged_files.hpp).
inline constexpr const char* hidden_folder = ".fascicle-part-";
/// A path as a user knows it: without such folders.
std::string shown_path(const std::filesystem::path& path);

/// Makes the missing folders of a path; those that are still empty when this goes, unless kept, are removed again.
class MadeFolders {
public:
    /// Error naming the folder and the system's reason.
    explicit MadeFolders(std::filesystem::path folder);
    ~MadeFolders();
    MadeFolders(const MadeFolders&) = delete;
    MadeFolders& operator=(const MadeFolders&) = delete;
    void keep() { made_.clear(); }

private:
    std::filesystem::path folder_, made_; ///< made_: the highest one that was not there before, empty: none
};

/// A name beside `path` for what becomes this file, as AtomicFile takes one: with the number of the program, by which what a killed one
/// left is known and removed, here and now.
std::filesystem::path temporary_name(const std::filesystem::path& path);

/// Writes to a temporary file in the same folder; commit() flushes, checks and renames it to `path`.
/// Without commit() the destructor removes it: no half-written file is left under a final name. Temporary files that killed programs
/// left of the same name (those whose program is no longer there, and no others) are removed first.
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
    class Buffer : public std::streambuf {
    public:
        Buffer();
        ~Buffer() override { close(); }
        int file = -1;
        int reason = 0;
        void close();

    protected:
        int_type overflow(int_type c) override;
        std::streamsize xsputn(const char* data, std::streamsize size) override;
        int sync() override;

    private:
        bool put(const char* data, std::size_t size);
        std::vector<char> block_;
    };

    std::filesystem::path path_;
    MadeFolders folders_;
    std::filesystem::path temporary_;
    Buffer buffer_;
    std::ostream stream_{&buffer_};
};

/// AtomicFile for text or bytes that are already in memory.
void write_file(const std::filesystem::path& path, const std::string& bytes);

/// The same for a document of the user's, flushed to the disk: what a link points to is replaced, not the link; permissions
/// stay; a write-protected file is an Error.
void write_document(const std::filesystem::path& path, const std::string& bytes);

} // namespace fascicle
