#include "io/osim_export/xml_text.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/param_table.hpp"
#include "fascicle/base/text.hpp"
#include "io/formats/xml_reader.hpp"

namespace fascicle::io {
namespace {

/// Bytes that are no UTF-8, such as those of old file names, are replaced: the file would not be read.
std::string legal(std::string_view text) {
    return xml_escaped(valid_utf8(text));
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
