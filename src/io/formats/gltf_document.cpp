#include "io/formats/gltf_document.hpp"

#include "fascicle/base/error.hpp"
#include "io/formats/text_scanner.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace fascicle::io {

namespace {

/// A JSON chunk above this is refused: as values it would take many times as much.
constexpr std::size_t most_json = std::size_t{32} << 20;

// Numbers of the specification, section 5.1.
enum ComponentType {
    signed_byte = 5120,
    unsigned_byte,
    signed_short,
    unsigned_short,
    unsigned_int = 5125,
    single
};

std::size_t width_of(int type) {
    switch (type) {
    case signed_byte:
    case unsigned_byte:
        return 1;
    case signed_short:
    case unsigned_short:
        return 2;
    case unsigned_int:
    case single:
        return 4;
    default:
        return 0;
    }
}

template <typename Value>
Value value_at(const unsigned char* bytes) {
    Value value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

/// Section 3.6.2.2: normalised integers are shares of the largest one.
float component(const unsigned char* bytes, int type, bool normalised) {
    double value = 0, most = 1;
    switch (type) {
    case signed_byte:
        value = value_at<std::int8_t>(bytes), most = 127;
        break;
    case unsigned_byte:
        value = value_at<std::uint8_t>(bytes), most = 255;
        break;
    case signed_short:
        value = value_at<std::int16_t>(bytes), most = 32767;
        break;
    case unsigned_short:
        value = value_at<std::uint16_t>(bytes), most = 65535;
        break;
    case unsigned_int:
        value = value_at<std::uint32_t>(bytes), most = 4294967295.0;
        break;
    default:
        return value_at<float>(bytes);
    }
    return static_cast<float>(normalised ? std::max(value / most, -1.0) : value);
}

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
    return value_at<std::uint32_t>(reinterpret_cast<const unsigned char*>(bytes.data()) + at);
}

} // namespace

GltfDocument::GltfDocument(std::string_view bytes, std::string file) : file_(std::move(file)) {
    read_chunks(bytes);
    // Every value takes a byte of the file at least; twice that, since arrays may be used again.
    budget_ = 2 * bytes.size() + 100000;
    const Json asset = json_.value("asset", Json::object());
    const std::string version = asset.is_object() && asset.contains("version") && asset["version"].is_string()
                                    ? asset["version"].get<std::string>()
                                    : "";
    if (version.substr(0, 2) != "2.")
        fail("glTF version " + (version.empty() ? "not said" : shown(version)), "2.0");
    if (json_.contains("extensionsRequired") && json_["extensionsRequired"].is_array())
        for (const Json& extension : json_["extensionsRequired"])
            if (!extension.is_string() || extension.get<std::string>() != "KHR_mesh_quantization")
                fail("it needs the extension " +
                         (extension.is_string() ? shown(extension.get<std::string>()) : "?"),
                     "a file without compression and other extensions");
}

void GltfDocument::read_chunks(std::string_view bytes) {
    const auto bad = [&](std::size_t at, const std::string& what, const std::string& expected) {
        throw_error(file_ + ", byte " + std::to_string(at), what, expected);
    };
    if (bytes.size() < 20 || bytes.substr(0, 4) != "glTF")
        bad(0, bytes.size() < 20 ? "the file ends" : "not a binary glTF",
            "glTF, version, length, and a JSON chunk");
    if (word_at(bytes, 4) != 2)
        bad(4, "version " + std::to_string(word_at(bytes, 4)), "2");
    if (word_at(bytes, 8) > bytes.size())
        bad(8, "the file is " + std::to_string(bytes.size()) + " bytes long",
            std::to_string(word_at(bytes, 8)) + " bytes, as its header says");
    const std::string_view all = bytes.substr(0, word_at(bytes, 8));
    std::string_view json;
    bool has_binary = false;
    for (std::size_t at = 12, n = 0; all.size() >= at && all.size() - at >= 8; ++n) {
        const std::size_t size = word_at(all, at);
        const std::string_view type = all.substr(at + 4, 4);
        if (size > all.size() - at - 8)
            bad(at, "a chunk of " + std::to_string(size) + " bytes", "no more than the file has");
        const std::string_view chunk = all.substr(at + 8, size);
        if (n == 0 && type == "JSON")
            json = chunk;
        else if (n == 1 && type == std::string_view("BIN\0", 4))
            binary_ = chunk, has_binary = true;
        at += 8 + size;
    }
    if (json.empty())
        bad(12, "no JSON chunk", "one first");
    if (json.size() > most_json)
        bad(12, "a JSON chunk of " + std::to_string(json.size()) + " bytes",
            "at most " + std::to_string(most_json));
    json_ = parse_json_object(json, file_);
    const Json& buffers = list("buffers");
    for (const Json& buffer : buffers)
        if (buffer.contains("uri") || &buffer != &buffers[0] || !has_binary)
            fail("it keeps its numbers in other files", "one .glb that holds everything");
    if (!buffers.empty())
        if (const std::int64_t size = integer(buffers[0], "byteLength", 0);
            size < 0 || static_cast<std::uint64_t>(size) > binary_.size())
            fail("a buffer of " + std::to_string(size) + " bytes", "no more than the binary chunk has");
}

void GltfDocument::fail(const std::string& what, const std::string& expected) const {
    throw_error(file_, what, expected);
}

const Json& GltfDocument::list(const char* name) const {
    static const Json none = Json::array();
    const auto found = json_.find(name);
    if (found == json_.end())
        return none;
    if (!found->is_array())
        fail(std::string("\"") + name + "\" is " + found->type_name(), "a list");
    for (const Json& entry : *found)
        if (!entry.is_object())
            fail(std::string("an entry of \"") + name + "\" is " + entry.type_name(), "an object");
    return *found;
}

const Json& GltfDocument::entry(const char* name, std::int64_t index, const std::string& user) const {
    const auto found = json_.find(name);
    const std::size_t count = found == json_.end() || !found->is_array() ? 0 : found->size();
    if (index < 0 || static_cast<std::uint64_t>(index) >= count)
        fail(user + " names number " + std::to_string(index) + " of " + name,
             count == 0 ? "there are none" : "0 to " + std::to_string(count - 1));
    const Json& entry = (*found)[static_cast<std::size_t>(index)];
    if (!entry.is_object())
        fail(std::string("an entry of \"") + name + "\" is " + entry.type_name(), "an object");
    return entry;
}

std::int64_t GltfDocument::integer(const Json& object, const char* key, std::int64_t otherwise) const {
    const auto found = object.find(key);
    if (found == object.end())
        return otherwise;
    if (!found->is_number_integer())
        fail(std::string("\"") + key + "\" is " + found->type_name(), "a whole number");
    if (found->is_number_unsigned() && found->get<std::uint64_t>() > std::uint64_t{1} << 62)
        fail(std::string("\"") + key + "\" is too large");
    return found->get<std::int64_t>();
}

void GltfDocument::spend(std::size_t values) {
    if (values > budget_)
        fail("its lists name the same numbers again and again, more than the file can hold",
             "a file whose numbers stand in it");
    budget_ -= values;
}

/// First byte of `count` elements; stride: of the view, or the element's size.
const unsigned char* GltfDocument::bytes_of(const Json& source, std::size_t count, std::size_t element,
                                            std::size_t& stride, const std::string& user) const {
    const Json& view = entry("bufferViews", integer(source, "bufferView", -1), user);
    const std::int64_t start = integer(view, "byteOffset", 0), length = integer(view, "byteLength", -1);
    const std::int64_t step = integer(view, "byteStride", static_cast<std::int64_t>(element));
    const std::int64_t offset = integer(source, "byteOffset", 0);
    const auto room = static_cast<std::int64_t>(binary_.size());
    if (integer(view, "buffer", -1) != 0 || start < 0 || length < 0 || start > room || length > room - start)
        fail(user + " has a buffer view outside of the binary chunk", std::to_string(room) + " bytes");
    if (step < static_cast<std::int64_t>(element) || step > 255 + static_cast<std::int64_t>(element) ||
        offset < 0 || offset > length)
        fail(user + " has a bad stride or offset");
    stride = static_cast<std::size_t>(step);
    const auto left = static_cast<std::size_t>(length - offset);
    if (count > 0 && (left < element || (left - element) / stride < count - 1))
        fail(user + " has " + std::to_string(count) + " values, more than its buffer view",
             "a buffer view that is long enough");
    return reinterpret_cast<const unsigned char*>(binary_.data()) + start + offset;
}

GltfDocument::Layout GltfDocument::layout(const Json& accessor, const std::string& user) {
    static constexpr std::array<std::pair<const char*, std::size_t>, 5> types{
        {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}}};
    Layout out;
    const std::int64_t count = integer(accessor, "count", -1), type = integer(accessor, "componentType", -1);
    out.type = static_cast<int>(std::clamp<std::int64_t>(type, 0, 10000));
    out.width = width_of(out.type);
    const auto name = accessor.find("type");
    if (name != accessor.end() && name->is_string())
        for (const auto& [known, components] : types)
            if (name->get_ref<const std::string&>() == known)
                out.components = components;
    if (count < 0 || static_cast<std::uint64_t>(count) > max_elements || out.width == 0 ||
        out.components == 0)
        fail(user + " has an accessor with a bad count or type");
    out.count = static_cast<std::size_t>(count);
    if (const auto found = accessor.find("normalized"); found != accessor.end())
        out.normalised = found->is_boolean() && found->get<bool>();
    spend(out.count * out.components);
    if (accessor.contains("bufferView"))
        out.data = bytes_of(accessor, out.count, out.width * out.components, out.stride, user);
    return out;
}

GltfDocument::Floats GltfDocument::floats(std::int64_t accessor, std::size_t components,
                                          const std::string& user) {
    if (const auto found = kept_.find({accessor, components}); found != kept_.end())
        return found->second;
    const Json& json = entry("accessors", accessor, user);
    const Layout from = layout(json, user);
    if (from.components != components)
        fail(user + " has " + std::to_string(from.components) + " numbers each", std::to_string(components));
    auto values = std::make_shared<std::vector<float>>(from.count * components, 0.0f);
    const auto read = [&](const unsigned char* at, std::size_t i) {
        for (std::size_t c = 0; c < components; ++c) {
            const float value = component(at + c * from.width, from.type, from.normalised);
            if (!std::isfinite(value))
                fail(user + " has a value that is not finite, number " + std::to_string(i), "finite values");
            (*values)[i * components + c] = value;
        }
    };
    if (from.data != nullptr)
        for (std::size_t i = 0; i < from.count; ++i)
            read(from.data + i * from.stride, i);
    if (const auto sparse = json.find("sparse"); sparse != json.end()) {
        if (!sparse->is_object() || !sparse->contains("indices") || !sparse->contains("values") ||
            !(*sparse)["indices"].is_object() || !(*sparse)["values"].is_object())
            fail(user + " has a sparse accessor without indices or values");
        const Json &places = (*sparse)["indices"], &changed = (*sparse)["values"];
        const std::int64_t count = integer(*sparse, "count", -1), type = integer(places, "componentType", -1);
        const std::size_t width = type == unsigned_byte || type == unsigned_short || type == unsigned_int
                                      ? width_of(static_cast<int>(type))
                                      : 0;
        if (count < 0 || static_cast<std::uint64_t>(count) > from.count || width == 0)
            fail(user + " has a sparse accessor with a bad count or type");
        const auto n = static_cast<std::size_t>(count);
        spend(n);
        std::size_t place_stride = 0, stride = 0;
        const unsigned char* place = bytes_of(places, n, width, place_stride, user);
        const unsigned char* value = bytes_of(changed, n, from.width * components, stride, user);
        for (std::size_t i = 0; i < n; ++i) {
            const unsigned char* at = place + i * place_stride;
            const std::size_t index = width == 1   ? value_at<std::uint8_t>(at)
                                      : width == 2 ? value_at<std::uint16_t>(at)
                                                   : value_at<std::uint32_t>(at);
            if (index >= from.count)
                fail(user + " has a sparse accessor with an index out of range");
            read(value + i * stride, index);
        }
    }
    kept_[{accessor, components}] = values;
    return values;
}

std::vector<std::uint32_t> GltfDocument::indices(std::int64_t accessor, std::size_t end,
                                                 const std::string& user) {
    const Layout from = layout(entry("accessors", accessor, user), user);
    if (from.components != 1 || from.data == nullptr ||
        (from.type != unsigned_byte && from.type != unsigned_short && from.type != unsigned_int))
        fail(user + " has indices of a bad type", "unsigned whole numbers");
    std::vector<std::uint32_t> values(from.count);
    for (std::size_t i = 0; i < from.count; ++i) {
        const unsigned char* at = from.data + i * from.stride;
        values[i] = from.width == 1   ? value_at<std::uint8_t>(at)
                    : from.width == 2 ? value_at<std::uint16_t>(at)
                                      : value_at<std::uint32_t>(at);
        if (values[i] >= end)
            fail(user + " has index " + std::to_string(values[i]),
                 "0 to " + std::to_string(end) + " - 1, its points");
    }
    return values;
}

} // namespace fascicle::io
