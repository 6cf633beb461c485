#pragma once
// A small pull parser for the XML of scientific files: elements, attributes, text. No namespaces, and no DTD: a file with one
// is refused, so that no entity is ever expanded.

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace fascicle::io {

/// Text fit to stand in an attribute or between elements; control characters become spaces.
std::string xml_escaped(std::string_view text);

class XmlReader {
public:
    enum class Event { start, end, text, finished };

    /// `bytes` must outlive the reader.
    XmlReader(std::string_view bytes, std::string file) : bytes_(bytes), file_(std::move(file)) {}

    /// Next event. An empty element gives start and end. Comments, declarations and white space between
    /// elements are passed over. Error naming file and line when the text is not well-formed.
    Event next();
    /// Name of the element that starts or ends.
    const std::string& name() const { return name_; }
    /// Attribute of the element that starts; empty when it has none of that name.
    const std::string& attribute(const std::string& key) const;
    bool has_attribute(const std::string& key) const { return attributes_.count(key) > 0; }
    /// Text as it stands in the file, entities not replaced, without white space at its ends.
    std::string_view text() const { return text_; }
    /// Where the last event starts.
    std::size_t position() const { return event_start_; }
    /// Where reading goes on.
    std::size_t after() const { return position_; }
    /// Passes over everything up to the end of the element that has just started.
    void skip_element();

    [[noreturn]] void fail(const std::string& what, const std::string& expected = {}) const;

private:
    void skip_space();
    void skip_past(std::string_view mark, const char* what);
    std::string read_name();
    void read_attributes();
    static std::string without_entities(std::string_view text);

    std::string_view bytes_;
    std::string file_;
    std::size_t position_ = 0;
    std::size_t event_start_ = 0;
    std::vector<std::string> open_; ///< names of the elements around here
    bool pending_end_ = false;
    std::string name_;
    std::map<std::string, std::string> attributes_;
    std::string_view text_;
};

} // namespace fascicle::io
