#pragma once
// Where computed things are kept under a key, by whoever knows about files.

#include <optional>
#include <string>
#include <string_view>

namespace fascicle {

/// Forgets when it likes, never fails: what cannot be kept is not kept, what is damaged is not found. May be used
/// from several threads and several programs at once.
class BlobStore {
public:
    virtual ~BlobStore() = default;
    /// `key`: a hash in hexadecimal digits, of everything that the bytes depend on.
    virtual std::optional<std::string> find(const std::string& key) = 0;
    virtual void keep(const std::string& key, std::string_view bytes) = 0;
};

} // namespace fascicle
