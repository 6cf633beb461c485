#include "io/osim/osim_document.hpp"

#include "fascicle/base/error.hpp"
#include "io/formats/text_scanner.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::io {
namespace {

constexpr std::size_t most_bytes = std::size_t{64} << 20;
constexpr std::ptrdiff_t most_tags = 2'000'000; // some 130 bytes each in memory, whatever they hold

} // namespace

OsimDocument::OsimDocument(std::string_view bytes, std::string file) : bytes_(bytes), file_(std::move(file)) {
    if (bytes_.starts_with("\xef\xbb\xbf"))
        bytes_.remove_prefix(3);
    if (bytes_.size() > most_bytes)
        throw_error(file_, "has " + std::to_string(bytes_.size() >> 20) + " MB", "a model of 64 MB at most");
    if (const std::size_t zero = bytes_.find('\0'); zero != std::string_view::npos)
        throw_error(file_ + ", byte " + std::to_string(zero), "a zero byte", "text: is this an .osim file?");
    if (std::count(bytes_.begin(), bytes_.end(), '<') > most_tags)
        throw_error(file_, "has more than two million tags", "a model");
    // No entities but XML's own, no DTD; bytes are taken as they are, since names in old files are not always UTF-8.
    constexpr unsigned int flags =
        pugi::parse_escapes | pugi::parse_cdata | pugi::parse_eol | pugi::parse_doctype;
    const pugi::xml_parse_result result =
        document_.load_buffer(bytes_.data(), bytes_.size(), flags, pugi::encoding_utf8);
    if (!result) {
        std::string what = result.description();
        if (!what.empty() && what.front() >= 'A' && what.front() <= 'Z')
            what.front() = static_cast<char>(what.front() - 'A' + 'a');
        throw_error(file_ + ", line " + std::to_string(line_of(result.offset)), what, "well-formed XML");
    }
    for (const pugi::xml_node node : document_.children())
        if (node.type() == pugi::node_doctype)
            fail(node, "a document type (entities)", "XML without one");
}

std::size_t OsimDocument::line_of(std::ptrdiff_t offset) const {
    const auto end =
        bytes_.begin() + std::clamp<std::ptrdiff_t>(offset, 0, static_cast<std::ptrdiff_t>(bytes_.size()));
    return static_cast<std::size_t>(std::count(bytes_.begin(), end, '\n')) + 1;
}

void OsimDocument::fail(pugi::xml_node node, const std::string& what, const std::string& expected) const {
    throw_error(file_ + ", line " + std::to_string(line_of(node.offset_debug())), what, expected);
}

std::string_view OsimDocument::text(pugi::xml_node parent, const char* child) {
    return trimmed(parent.child(child).text().get());
}

pugi::xml_node OsimDocument::first_of(pugi::xml_node parent, std::initializer_list<const char*> children) {
    for (const char* child : children)
        if (const pugi::xml_node found = parent.child(child))
            return found;
    return {};
}

pugi::xml_node OsimDocument::first_element(pugi::xml_node parent) {
    for (const pugi::xml_node child : parent.children())
        if (child.type() == pugi::node_element)
            return child;
    return {};
}

std::vector<double> OsimDocument::numbers(pugi::xml_node element) const {
    std::vector<double> values;
    TextScanner words(element.text().get(), file_);
    for (std::string_view word; !(word = words.next_word()).empty();) {
        double value = 0;
        if (to_double(word, value) != NumberCheck::ok || !std::isfinite(value))
            fail(element, std::string(element.name()) + " holds " + shown(word), "numbers");
        values.push_back(value);
    }
    return values;
}

std::vector<double> OsimDocument::numbers(pugi::xml_node parent, const char* child) const {
    return numbers(parent.child(child));
}

std::vector<double> OsimDocument::numbers(pugi::xml_node parent, const char* child, std::size_t count) const {
    const pugi::xml_node element = parent.child(child);
    if (!element)
        return {};
    std::vector<double> values = numbers(element);
    if (values.size() != count)
        fail(element, std::string(child) + " holds " + std::to_string(values.size()) + " numbers",
             std::to_string(count));
    return values;
}

double OsimDocument::number(pugi::xml_node parent, const char* child, double otherwise) const {
    const std::vector<double> values = numbers(parent, child, 1);
    return values.empty() ? otherwise : values.front();
}

Vec3 OsimDocument::vector(pugi::xml_node parent, const char* child, const Vec3& otherwise) const {
    const std::vector<double> values = numbers(parent, child, 3);
    return values.empty() ? otherwise : Vec3(values[0], values[1], values[2]);
}

bool OsimDocument::flag(pugi::xml_node parent, const char* child, bool otherwise) const {
    const std::string value = lower_case(text(parent, child));
    if (value.empty())
        return otherwise;
    if (value != "true" && value != "false" && value != "1" && value != "0")
        fail(parent.child(child), std::string(child) + " is " + shown(value), "true or false");
    return value == "true" || value == "1";
}

std::vector<pugi::xml_node> members(pugi::xml_node set) {
    std::vector<pugi::xml_node> found;
    const pugi::xml_node objects = set.child("objects");
    for (const pugi::xml_node child : (objects ? objects : set).children())
        if (child.type() == pugi::node_element)
            found.push_back(child);
    return found;
}

} // namespace fascicle::io
