#pragma once
// Computed things kept in a folder between runs.

#include "fascicle/base/blob_store.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>

namespace fascicle {

/// One file per key, complete or not there (AtomicFile), so that several programs may share the folder, and anything in
/// it may be deleted at any time. A file that is damaged, cut off, of another key or of another make is passed
/// over and in time replaced. A folder that cannot be made or written to keeps nothing. When the files
/// together exceed max_bytes, those found longest ago go first. No member throws or prints.
class DiskCache : public BlobStore {
public:
    static constexpr std::uintmax_t default_max_bytes = std::uintmax_t{1} << 30;

    explicit DiskCache(std::filesystem::path folder, std::uintmax_t max_bytes = default_max_bytes);

    std::optional<std::string> find(const std::string& key) override;
    void keep(const std::string& key, std::string_view bytes) override;

    /// What the file of a key holds; nothing when `file_bytes` are not of this key, or not whole.
    static std::optional<std::string_view> content(const std::string& key, std::string_view file_bytes);

    const std::filesystem::path& folder() const { return folder_; }
    /// The file of a key, there or not.
    std::filesystem::path file_of(const std::string& key) const;

private:
    void remove_surplus(const std::filesystem::path& newest) const;

    std::filesystem::path folder_;
    std::uintmax_t max_bytes_;
};

/// $FASCICLE_CACHE, else $XDG_CACHE_HOME/fascicle, else $HOME/.cache/fascicle. Empty: FASCICLE_CACHE is set to
/// nothing, or there is no home.
std::filesystem::path cache_folder();

/// The cache in cache_folder(); null when that is empty.
std::shared_ptr<BlobStore> open_cache();

} // namespace fascicle
