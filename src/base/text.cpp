#include "fascicle/base/text.hpp"

#include "fascicle/base/state_hash.hpp"

#include <algorithm>

namespace fascicle {
namespace {

unsigned byte(std::string_view text, std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
}

/// Bytes of the character at `i`, 0 when there is none.
std::size_t character_at(std::string_view text, std::size_t i) {
    const unsigned first = byte(text, i), second = byte(text, i + 1);
    if (first < 0x80)
        return 1;
    const std::size_t length = first >= 0xC2 && first <= 0xDF   ? 2
                               : first >= 0xE0 && first <= 0xEF ? 3
                               : first >= 0xF0 && first <= 0xF4 ? 4
                                                                : 0;
    for (std::size_t k = 1; k < length; ++k)
        if ((byte(text, i + k) & 0xC0) != 0x80)
            return 0;
    // The second byte of the first and last lead bytes has a range of its own (RFC 3629, section 4).
    const bool good = (first != 0xE0 || second >= 0xA0) && (first != 0xED || second < 0xA0) &&
                      (first != 0xF0 || second >= 0x90) && (first != 0xF4 || second < 0x90);
    return good ? length : 0;
}

bool is_control(char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
}

} // namespace

std::string one_line(std::string_view text) {
    std::string out(text);
    std::replace_if(out.begin(), out.end(), is_control, ' ');
    return out;
}

std::string valid_utf8(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = character_at(text, i);
        out += length > 0 ? text.substr(i, length) : "\xEF\xBF\xBD";
        i += std::max<std::size_t>(1, length);
    }
    return out;
}

std::string file_name_for(std::string_view name) {
    constexpr std::size_t longest =
        150; // of the 255 that file systems take: a frame, an extension and more follow
    std::string out(name);
    std::replace_if(
        out.begin(), out.end(), [](char c) { return c == '/' || c == '\\' || is_control(c); }, '_');
    if (out.empty() || out[0] == '.')
        out.insert(out.begin(), '_');
    if (out.size() <= longest)
        return out;
    StateHash hash;
    hash.add_bytes(name.data(), name.size());
    std::size_t cut = longest - 17;
    while (cut > 0 && (byte(out, cut) & 0xC0) == 0x80) // not into a character
        --cut;
    return out.substr(0, cut) + "-" + hash.hex();
}

} // namespace fascicle
