#include "io/formats/array_names.hpp"

namespace fascicle::io {

std::string encoded_byte(char c) {
    constexpr const char* digits = "0123456789ABCDEF";
    const auto byte = static_cast<unsigned char>(c);
    return {'%', digits[byte >> 4], digits[byte & 15]};
}

std::string encoded_name(std::string_view name) {
    std::string out;
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte > 0x20 && byte < 0x7f && c != '%' && c != '"')
            out += c;
        else
            out += encoded_byte(c);
    }
    return out.empty() ? "%20" : out;
}

std::string decoded_name(std::string_view name) {
    const auto digit = [](char c) {
        return c >= '0' && c <= '9'   ? c - '0'
               : c >= 'A' && c <= 'F' ? c - 'A' + 10
               : c >= 'a' && c <= 'f' ? c - 'a' + 10
                                      : -1;
    };
    std::string out;
    for (std::size_t i = 0; i < name.size(); ++i)
        if (name[i] == '%' && i + 2 < name.size() && digit(name[i + 1]) >= 0 && digit(name[i + 2]) >= 0) {
            out += static_cast<char>(16 * digit(name[i + 1]) + digit(name[i + 2]));
            i += 2;
        } else {
            out += name[i];
        }
    return out;
}

} // namespace fascicle::io
