#include "fascicle/io/disk_cache.hpp"

#include "fascicle/base/content_hash.hpp"
#include "fascicle/io/files.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace fascicle {
namespace fs = std::filesystem;

namespace {

constexpr std::string_view extension = ".fascicle-cache";
constexpr std::size_t key_size = 32;

/// The last digit is the version of this header. Read on a machine of the other byte order the checksum is wrong.
struct Header {
    std::array<char, 16> magic{'f', 'a', 's', 'c', 'i', 'c', 'l', 'e',
                               ' ', 'c', 'a', 'c', 'h', 'e', ' ', '1'};
    std::array<char, key_size> key{};
    std::uint64_t size = 0; ///< of what follows
    std::array<std::uint64_t, 2> checksum{};
};
static_assert(sizeof(Header) == 16 + key_size + 24);

bool is_key(const std::string& key) {
    return key.size() == key_size && key.find_first_not_of("0123456789abcdef") == std::string::npos;
}

Header header_for(const std::string& key, std::string_view bytes) {
    Header header;
    std::copy(key.begin(), key.end(), header.key.begin());
    header.size = bytes.size();
    ContentHash hash;
    hash.add_bytes(bytes.data(), bytes.size());
    header.checksum = hash.value();
    return header;
}

const char* environment(const char* name) {
    return std::getenv(name); // the environment is only read, never changed, while threads run
}

} // namespace

DiskCache::DiskCache(fs::path folder, std::uintmax_t max_bytes)
    : folder_(std::move(folder)), max_bytes_(max_bytes) {}

fs::path DiskCache::file_of(const std::string& key) const {
    return folder_ / (key + std::string(extension));
}

std::optional<std::string_view> DiskCache::content(const std::string& key, std::string_view file_bytes) {
    if (!is_key(key) || file_bytes.size() < sizeof(Header))
        return std::nullopt;
    const std::string_view bytes = file_bytes.substr(sizeof(Header));
    const Header expected = header_for(key, bytes);
    if (std::memcmp(file_bytes.data(), &expected, sizeof expected) != 0)
        return std::nullopt;
    return bytes;
}

std::optional<std::string> DiskCache::find(const std::string& key) {
    if (!is_key(key))
        return std::nullopt;
    try {
        const fs::path file = file_of(key);
        if (std::error_code code; !fs::is_regular_file(file, code))
            return std::nullopt; // nor wait for a pipe
        std::string bytes = read_file(file, static_cast<std::size_t>(max_bytes_));
        if (!content(key, bytes))
            return std::nullopt;
        std::error_code ignored; // a folder that others own may be read only
        fs::last_write_time(file, fs::file_time_type::clock::now(), ignored);
        bytes.erase(0, sizeof(Header));
        return bytes;
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

void DiskCache::keep(const std::string& key, std::string_view bytes) {
    if (!is_key(key) || bytes.size() + sizeof(Header) > max_bytes_)
        return;
    try {
        const Header header = header_for(key, bytes);
        AtomicFile file(file_of(key));
        file.write(&header, sizeof header);
        file.write(bytes.data(), bytes.size());
        file.commit();
        remove_surplus(file_of(key));
    } catch (const std::exception&) {
        // The next run computes it again.
    }
}

void DiskCache::remove_surplus(const fs::path& newest) const {
    struct Entry {
        fs::path path;
        fs::file_time_type time;
        std::uintmax_t size;
    };
    std::vector<Entry> entries;
    std::uintmax_t total = 0;
    const auto now = fs::file_time_type::clock::now();
    for (const fs::directory_entry& found : fs::directory_iterator(folder_)) {
        std::error_code code;
        const std::string name = found.path().filename().string();
        // Only what has a name of ours: the user may have pointed the cache at a folder of other things.
        const std::string rest = name.size() > key_size ? name.substr(key_size) : std::string();
        const bool partial = rest.starts_with(std::string(extension) + ".part"); // of an AtomicFile
        const bool ours = is_key(name.substr(0, key_size)) && (partial || rest == extension);
        if (!ours || found.is_symlink(code) || !found.is_regular_file(code))
            continue;
        const Entry entry{found.path(), found.last_write_time(code), found.file_size(code)};
        if (code)
            continue; // another program has just removed it
        if (partial && now - entry.time > std::chrono::hours(1)) {
            fs::remove(entry.path, code); // left by a program that was killed
            continue;
        }
        total += entry.size;
        if (!partial && entry.path != newest)
            entries.push_back(entry);
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
        return a.time != b.time ? a.time < b.time : a.path < b.path;
    });
    for (const Entry& entry : entries) {
        if (total <= max_bytes_)
            return;
        std::error_code ignored;
        fs::remove(entry.path, ignored);
        total -= entry.size;
    }
}

fs::path cache_folder() {
    if (const char* own = environment("FASCICLE_CACHE"))
        return own;
    // The XDG base directory specification: a path that is not absolute is to be ignored.
    if (const char* xdg = environment("XDG_CACHE_HOME"); xdg != nullptr && fs::path(xdg).is_absolute())
        return fs::path(xdg) / "fascicle";
    if (const char* home = environment("HOME"); home != nullptr && fs::path(home).is_absolute())
        return fs::path(home) / ".cache" / "fascicle";
    return {};
}

std::shared_ptr<BlobStore> open_cache() {
    const fs::path folder = cache_folder();
    return folder.empty() ? nullptr : std::make_shared<DiskCache>(folder);
}

} // namespace fascicle
