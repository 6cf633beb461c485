#pragma once
// PNG pictures: 8 bits a channel, red green blue alpha, rows from the top, no padding.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace fascicle {

struct PngImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba; ///< 4 * width * height bytes
};

/// Writes 4 * width * height bytes. Opaque pictures are stored without alpha. Quick rather than small: the
/// lowest compression and one row filter. Error naming the file; width and height from 1 to 32768.
void write_png(const std::filesystem::path& path, int width, int height, const std::uint8_t* rgba);

/// The same as bytes, for what carries its pictures inside.
std::string encode_png(int width, int height, const std::uint8_t* rgba);

/// Reads any PNG as RGBA (missing alpha becomes 255, 16 bits become 8). Error naming the file when it is not
/// a PNG, is damaged, or claims more pixels than its size in bytes can hold.
PngImage read_png(const std::filesystem::path& path);
/// The same from bytes in memory; `name` stands for the file in messages.
PngImage decode_png(std::string_view bytes, const std::string& name);

} // namespace fascicle
