#include "io/osim_export/xml_text.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/param_table.hpp"
#include "io/formats/xml_reader.hpp"

#include <algorithm>

namespace fascicle::io {
namespace {

/// Bytes of the UTF-8 character that begins here, 0 when there is none.
std::size_t character_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const std::size_t n = byte(0) < 0x80                       ? 1
                          : byte(0) >= 0xC2 && byte(0) <= 0xDF ? 2
                          : byte(0) >= 0xE0 && byte(0) <= 0xEF ? 3
                          : byte(0) >= 0xF0 && byte(0) <= 0xF4 ? 4
                                                               : 0;
    if (n == 0 || n > text.size())
        return 0;
    for (std::size_t i = 1; i < n; ++i)
        if ((byte(i) & 0xC0U) != 0x80U)
            return 0;
    // Longer than need be, half of a pair, beyond the last character.
    if ((byte(0) == 0xE0 && byte(1) < 0xA0) || (byte(0) == 0xED && byte(1) >= 0xA0) ||
        (byte(0) == 0xF0 && byte(1) < 0x90) || (byte(0) == 0xF4 && byte(1) >= 0x90))
        return 0;
    return n;
}

/// Bytes that are no UTF-8, such as those of old file names, become '?': the file would not be read.
std::string legal(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        const std::size_t n = character_length(text);
        result += n == 0 ? std::string_view("?") : text.substr(0, n);
        text.remove_prefix(std::max<std::size_t>(n, 1));
    }
    return xml_escaped(result);
}

} // namespace

void XmlText::begin_line() {
    out_.append(open_.size(), '\t');
}

XmlText& XmlText::open(std::string_view tag, std::string_view attribute, std::string_view value) {
    begin_line();
    out_.append("<").append(tag);
    if (!attribute.empty())
        out_.append(" ").append(attribute).append("=\"").append(legal(value)).append("\"");
    out_ += ">\n";
    open_.emplace_back(tag);
    return *this;
}

XmlText& XmlText::close() {
    FASCICLE_ASSERT(!open_.empty());
    const std::string tag = open_.back();
    open_.pop_back();
    begin_line();
    out_.append("</").append(tag).append(">\n");
    return *this;
}

XmlText& XmlText::text(std::string_view tag, std::string_view value) {
    begin_line();
    out_.append("<").append(tag).append(">").append(legal(value));
    out_.append("</").append(tag).append(">\n");
    return *this;
}

XmlText& XmlText::number(std::string_view tag, double value) {
    return numbers(tag, {&value, 1});
}

XmlText& XmlText::numbers(std::string_view tag, std::span<const double> values) {
    std::string all;
    for (const double value : values)
        all.append(all.empty() ? "" : " ").append(number_text(value));
    return text(tag, all);
}

XmlText& XmlText::vector(std::string_view tag, const Vec3& v) {
    return numbers(tag, {v.data(), 3});
}

const std::string& XmlText::finished() const {
    FASCICLE_ASSERT(open_.empty());
    return out_;
}

} // namespace fascicle::io
