#include "io/base64.hpp"

#include <cstdint>

namespace fascicle::io {

std::string encode_base64(std::string_view bytes) {
    static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const auto byte = [&](std::size_t k) {
            return i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u;
        };
        const std::uint32_t bits = (byte(0) << 16) | (byte(1) << 8) | byte(2);
        out += digits[bits >> 18];
        out += digits[(bits >> 12) & 63];
        out += i + 1 < bytes.size() ? digits[(bits >> 6) & 63] : '=';
        out += i + 2 < bytes.size() ? digits[bits & 63] : '=';
    }
    return out;
}

bool decode_base64(std::string_view text, std::string& out) {
    std::uint32_t bits = 0;
    int digits = 0, padding = 0;
    out.reserve(text.size() / 4 * 3);
    for (const char c : text) {
        std::uint32_t value = 0;
        if (c >= 'A' && c <= 'Z')
            value = static_cast<std::uint32_t>(c - 'A');
        else if (c >= 'a' && c <= 'z')
            value = static_cast<std::uint32_t>(c - 'a' + 26);
        else if (c >= '0' && c <= '9')
            value = static_cast<std::uint32_t>(c - '0' + 52);
        else if (c == '+' || c == '/')
            value = c == '+' ? 62 : 63;
        else if (c == '=')
            ++padding;
        else if (c == ' ' || c == '\t' || c == '\r' || c == '\n')
            continue;
        else
            return false;
        if (c != '=' && padding > 0)
            return false;
        bits = (bits << 6) | value;
        if (++digits == 4) {
            if (padding > 2)
                return false;
            for (int i = 0; i < 3 - padding; ++i)
                out += static_cast<char>((bits >> (16 - 8 * i)) & 0xff);
            bits = 0;
            digits = padding = 0;
        }
    }
    return digits == 0;
}

} // namespace fascicle::io
