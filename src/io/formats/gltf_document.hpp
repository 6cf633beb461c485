#pragma once
// A .glb taken apart: its JSON, and numbers out of its binary chunk.

#include "io/json_fields.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace fascicle::io {

class GltfDocument {
public:
    /// `bytes` must outlive the document. Error naming `file` and the byte for what is no glTF 2.0 in one binary file, and for
    /// extensions that it needs and we do not know.
    GltfDocument(std::string_view bytes, std::string file);

    const Json& json() const { return json_; }
    const std::string& file() const { return file_; }
    /// The list of that name; an empty one when there is none. Error when it is no list of objects.
    const Json& list(const char* name) const;
    /// Entry `index` of a list. Error naming `user` when there is none.
    const Json& entry(const char* name, std::int64_t index, const std::string& user) const;

    using Floats = std::shared_ptr<const std::vector<float>>;
    /// Values of an accessor with that many components each; the same array when it is asked for again. Integers are
    /// floats, normalised where the accessor says so. Error for bad ranges, for values that are not finite, and when
    /// more would be unpacked than the file can be worth.
    Floats floats(std::int64_t accessor, std::size_t components, const std::string& user);
    /// Values of an accessor of whole numbers, each below `end`.
    std::vector<std::uint32_t> indices(std::int64_t accessor, std::size_t end, const std::string& user);

    [[noreturn]] void fail(const std::string& what, const std::string& expected = {}) const;
    /// A whole number of an object; Error when it is there and is none.
    std::int64_t integer(const Json& object, const char* key, std::int64_t otherwise) const;

private:
    struct Layout {
        std::size_t count = 0, components = 0, width = 0, stride = 0; ///< width: bytes of a component
        int type = 0;
        bool normalised = false;
        const unsigned char* data = nullptr; ///< null: zeros
    };
    void read_chunks(std::string_view bytes);
    Layout layout(const Json& accessor, const std::string& user);
    const unsigned char* bytes_of(const Json& source, std::size_t count, std::size_t element,
                                  std::size_t& stride, const std::string& user) const;
    void spend(std::size_t values);

    std::string file_;
    std::string_view binary_;
    Json json_;
    std::size_t budget_ = 0;
    std::map<std::pair<std::int64_t, std::size_t>, Floats> kept_;
};

} // namespace fascicle::io
