#include "fascicle/io/png.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/io/files.hpp"

#include <algorithm>
#include <memory>
#include <string>

// Static, so that the copies inside other libraries (libimgui.a carries parts of stb) stay apart.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 32768
#include <stb_image.h>
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb_image_write.h>
#pragma GCC diagnostic pop

namespace fascicle {

namespace {

// Deflate packs at most 1032 bytes into one.
constexpr double most_inflated = 1032.0;

/// Bits of a pixel, as the header says that stands at the beginning of every PNG; at least 1.
int bits_per_pixel(std::string_view bytes) {
    constexpr std::size_t depth_at = 24, kind_at = 25;
    const int depth = static_cast<unsigned char>(bytes[depth_at]),
              kind = static_cast<unsigned char>(bytes[kind_at]);
    const int channels = kind == 2 ? 3 : kind == 4 ? 2 : kind == 6 ? 4 : 1;
    return std::max(1, depth * channels);
}

constexpr std::size_t chunk_ends = 12; ///< bytes of a chunk that are no data: length, name, checksum

/// Data bytes that the chunk at `at` claims.
std::size_t chunk_length(std::string_view bytes, std::size_t at) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i)
        length = length << 8 | static_cast<unsigned char>(bytes[at + i]);
    return length;
}

/// Whether the data of all chunks end within the file: stb makes room for what a chunk says, at the end of the file, too.
bool chunks_fit(std::string_view bytes) {
    for (std::size_t at = 8; at + 8 <= bytes.size();) {
        const std::size_t length = chunk_length(bytes, at);
        if (length > bytes.size() - at - 8)
            return false;
        at += length + chunk_ends;
    }
    return true;
}

/// The file without IDAT chunks that hold nothing, which are allowed: stb would copy their no bytes to a null pointer.
std::string without_empty_data(std::string_view bytes) {
    std::string kept(bytes.substr(0, 8));
    for (std::size_t at = 8; at < bytes.size();) {
        const bool whole = at + 8 <= bytes.size();
        const std::size_t size = whole ? chunk_length(bytes, at) + chunk_ends : bytes.size() - at;
        if (!whole || size != chunk_ends || bytes.substr(at + 4, 4) != "IDAT")
            kept += bytes.substr(at, size);
        at += size;
    }
    return kept;
}

/// Why stb gave up. It names an unknown chunk by its four bytes: zeros, at the end of a file.
std::string failure_reason() {
    const std::string reason = stbi_failure_reason();
    return reason.empty() ? "it ends too early" : reason;
}

void append(void* bytes, void* data, int size) {
    static_cast<std::string*>(bytes)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

std::string pack(const std::string& name, int width, int height, const std::uint8_t* rgba) {
    FASCICLE_ASSERT(width >= 1 && height >= 1 && width <= 32768 && height <= 32768 && rgba != nullptr);
    // stb counts bytes in int: a 4-channel picture with its filter bytes must stay below 2^31.
    if (static_cast<double>(width) * height > 500e6)
        throw_error(name, "the picture is too large", "at most 500 million pixels");
    const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    bool opaque = true;
    for (std::size_t i = 0; i < pixels && opaque; ++i)
        opaque = rgba[4 * i + 3] == 255;
    std::vector<std::uint8_t> rgb;
    if (opaque) {
        rgb.resize(3 * pixels);
        for (std::size_t i = 0; i < pixels; ++i)
            for (std::size_t c = 0; c < 3; ++c)
                rgb[3 * i + c] = rgba[4 * i + c];
    }
    const int channels = opaque ? 3 : 4;
    // stb's lowest level; trying all filters and packing harder takes 130 ms a picture. Set once: several threads pack.
    static const bool settled = [] {
        stbi_write_png_compression_level = 5;
        stbi_write_force_png_filter = 1;
        return true;
    }();
    (void)settled;
    std::string bytes;
    if (stbi_write_png_to_func(append, &bytes, width, height, channels, opaque ? rgb.data() : rgba,
                               width * channels) == 0)
        throw_error(name, "cannot pack the picture: out of memory");
    return bytes;
}

} // namespace

void write_png(const std::filesystem::path& path, int width, int height, const std::uint8_t* rgba) {
    write_file(path, pack(path.string(), width, height, rgba));
}

std::string encode_png(int width, int height, const std::uint8_t* rgba) {
    return pack("picture", width, height, rgba);
}

PngImage read_png(const std::filesystem::path& path) {
    return decode_png(read_file(path, std::size_t{1} << 30), path.string());
}

PngImage decode_png(std::string_view bytes, const std::string& name) {
    if (bytes.size() > std::size_t{1} << 30) // stb counts in int
        throw_error(name, "the picture has more than 1 GB", "a PNG file of at most 1 GB");
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int size = static_cast<int>(bytes.size());
    if (bytes.substr(0, 26).size() < 26 || bytes.substr(12, 4) != "IHDR") // first, as the standard wants it
        throw_error(name, "not a PNG picture", "a PNG file of at most 32768 pixels a side");
    PngImage image;
    int channels = 0;
    if (stbi_info_from_memory(data, size, &image.width, &image.height, &channels) == 0)
        throw_error(name, "not a PNG picture (" + failure_reason() + ")",
                    "a PNG file of at most 32768 pixels a side");
    const double pixels = static_cast<double>(image.width) * image.height;
    if (pixels > 500e6 ||
        pixels * bits_per_pixel(bytes) > 8 * most_inflated * static_cast<double>(bytes.size()))
        throw_error(name, "claims " + std::to_string(image.width) + "x" + std::to_string(image.height) +
                              " pixels, more than its " + std::to_string(bytes.size()) + " bytes can hold");
    if (!chunks_fit(bytes))
        throw_error(name, "damaged PNG picture (it ends within a chunk)");
    const std::string kept = without_empty_data(bytes);
    const std::unique_ptr<stbi_uc, void (*)(void*)> decoded(
        stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(kept.data()), static_cast<int>(kept.size()),
                              &image.width, &image.height, &channels, 4),
        stbi_image_free);
    if (!decoded)
        throw_error(name, "damaged PNG picture (" + failure_reason() + ")");
    image.rgba.assign(decoded.get(), decoded.get() + static_cast<std::size_t>(pixels) * 4);
    return image;
}

} // namespace fascicle
