#pragma once
// XML as text, element by element, indented; text escaped, numbers the shortest that read back the same, whatever the locale.

#include "fascicle/base/types.hpp"

#include <span>
#include <string>
#include <string_view>

namespace fascicle::io {

class XmlText {
public:
    /// Opens <tag>, or <tag attribute="value">.
    XmlText& open(std::string_view tag, std::string_view attribute = {}, std::string_view value = {});
    XmlText& close();
    XmlText& text(std::string_view tag, std::string_view value);
    XmlText& number(std::string_view tag, double value);
    XmlText& numbers(std::string_view tag, std::span<const double> values);
    XmlText& vector(std::string_view tag, const Vec3& v);
    XmlText& flag(std::string_view tag, bool value) { return text(tag, value ? "true" : "false"); }
    /// The text so far; every element must be closed.
    const std::string& finished() const;

private:
    void begin_line();
    std::string out_ = "<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n";
    std::vector<std::string> open_;
};

} // namespace fascicle::io
