#pragma once
// Numbers in binary files: any size, signed or not, whole or floating, either byte order.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace fascicle::io {

struct NumberType {
    char kind = 0;        ///< 'f' floating, 'i' signed, 'u' unsigned; 0 no type
    std::size_t size = 0; ///< bytes
};

/// The `size` bytes from `start`, which must be there, as an unsigned number.
inline std::uint64_t take_bits(std::string_view bytes, std::size_t start, std::size_t size, bool big_endian) {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < size; ++i)
        bits = (bits << 8) | static_cast<unsigned char>(bytes[start + (big_endian ? i : size - 1 - i)]);
    return bits;
}

inline double to_number(std::uint64_t bits, NumberType type) {
    if (type.kind == 'f')
        return type.size == 4 ? static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)))
                              : std::bit_cast<double>(bits);
    if (type.kind == 'u')
        return static_cast<double>(bits);
    const std::uint64_t sign = std::uint64_t{1} << (8 * type.size - 1);
    return static_cast<double>(static_cast<std::int64_t>((bits ^ sign) - sign));
}

inline void put_little_endian(std::string& out, std::uint64_t bits, int size) {
    for (int i = 0; i < size; ++i)
        out += static_cast<char>((bits >> (8 * i)) & 0xff);
}

} // namespace fascicle::io
