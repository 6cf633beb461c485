#include "io/formats/xml_reader.hpp"

#include "io/formats/text_scanner.hpp"

namespace fascicle::io {

std::string xml_escaped(std::string_view text) {
    std::string out;
    for (const char c : text)
        switch (c) {
        case '<':
            out += "&lt;";
            break;
        case '>':
            out += "&gt;";
            break;
        case '&':
            out += "&amp;";
            break;
        case '"':
            out += "&quot;";
            break;
        default:
            out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
        }
    // U+FFFE and U+FFFF are no characters of XML (section 2.2).
    for (std::size_t at = 0; (at = out.find("\xEF\xBF", at)) != std::string::npos; at += 2)
        if (at + 2 < out.size() && static_cast<unsigned char>(out[at + 2]) > 0xBD)
            out[at + 2] = '\xBD';
    return out;
}

void XmlReader::fail(const std::string& what, const std::string& expected) const {
    TextScanner(bytes_, file_).fail_at(event_start_, what, expected);
}

const std::string& XmlReader::attribute(const std::string& key) const {
    static const std::string none;
    const auto it = attributes_.find(key);
    return it == attributes_.end() ? none : it->second;
}

void XmlReader::skip_space() {
    while (position_ < bytes_.size() &&
           std::string_view(" \t\r\n").find(bytes_[position_]) != std::string_view::npos)
        ++position_;
}

void XmlReader::skip_past(std::string_view mark, const char* what) {
    const std::size_t end = bytes_.find(mark, position_);
    if (end == std::string_view::npos)
        fail(std::string(what) + " does not end", std::string(mark));
    position_ = end + mark.size();
}

std::string XmlReader::read_name() {
    const std::size_t start = position_;
    while (position_ < bytes_.size() &&
           std::string_view(" \t\r\n/>=<\"'").find(bytes_[position_]) == std::string_view::npos)
        ++position_;
    if (position_ == start || position_ - start > 1000)
        fail("bad name in an element", "an XML name");
    return std::string(bytes_.substr(start, position_ - start));
}

std::string XmlReader::without_entities(std::string_view text) {
    static constexpr std::pair<std::string_view, char> entities[] = {
        {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}, {"&amp;", '&'}};
    std::string out;
    for (;;) {
        const std::size_t mark = text.find('&');
        out += text.substr(0, mark);
        if (mark == std::string_view::npos)
            return out;
        text.remove_prefix(mark);
        std::size_t length = 1; // what is no entity stays
        char c = '&';
        for (const auto& [entity, meant] : entities)
            if (text.starts_with(entity)) {
                length = entity.size();
                c = meant;
            }
        out += c;
        text.remove_prefix(length);
    }
}

void XmlReader::read_attributes() {
    attributes_.clear();
    for (;;) {
        skip_space();
        if (position_ >= bytes_.size())
            fail("element <" + name_ + "> does not end", ">");
        if (bytes_[position_] == '>') {
            ++position_;
            return;
        }
        if (bytes_.substr(position_, 2) == "/>") {
            position_ += 2;
            pending_end_ = true;
            return;
        }
        const std::string key = read_name();
        skip_space();
        if (bytes_.substr(position_, 1) != "=")
            fail("attribute " + shown(key) + " without a value", "=\"...\"");
        ++position_;
        skip_space();
        const std::string_view quote = bytes_.substr(position_, 1);
        if (quote != "\"" && quote != "'")
            fail("attribute " + shown(key) + " without quotes", "=\"...\"");
        const std::size_t start = ++position_;
        skip_past(quote, "an attribute's value");
        attributes_[key] = without_entities(bytes_.substr(start, position_ - 1 - start));
        if (attributes_.size() > 1000)
            fail("too many attributes", "at most 1000");
    }
}

XmlReader::Event XmlReader::next() {
    if (pending_end_) {
        pending_end_ = false;
        open_.pop_back();
        return Event::end;
    }
    for (;;) {
        skip_space();
        event_start_ = position_;
        if (position_ >= bytes_.size()) {
            if (!open_.empty())
                fail("the file ends too early", "the end of an element");
            return Event::finished;
        }
        if (bytes_[position_] != '<') {
            position_ = std::min(bytes_.find('<', position_), bytes_.size());
            text_ = trimmed(bytes_.substr(event_start_, position_ - event_start_));
            if (open_.empty())
                fail("text outside all elements", "XML");
            return Event::text;
        }
        const std::string_view rest = bytes_.substr(position_);
        if (rest.substr(0, 4) == "<!--") {
            skip_past("-->", "a comment");
        } else if (rest.substr(0, 2) == "<?") {
            skip_past("?>", "a declaration");
        } else if (rest.substr(0, 2) == "<!") {
            fail("a document type, entities or unparsed text: " + shown(rest.substr(0, 20)),
                 "elements, text and comments");
        } else if (rest.substr(0, 2) == "</") {
            position_ += 2;
            name_ = read_name();
            skip_space();
            if (bytes_.substr(position_, 1) != ">" || open_.empty() || open_.back() != name_)
                fail("bad end of an element",
                     open_.empty() ? "an element that starts" : "</" + open_.back() + ">");
            ++position_;
            open_.pop_back();
            return Event::end;
        } else {
            ++position_;
            name_ = read_name();
            read_attributes();
            if (open_.size() >= 100)
                fail("elements nested too deeply", "at most 100 levels");
            open_.push_back(name_);
            return Event::start;
        }
    }
}

void XmlReader::skip_element() {
    for (int open = 1; open > 0;) {
        const Event event = next();
        if (event == Event::finished)
            fail("the file ends too early", "the end of an element");
        open += event == Event::start ? 1 : event == Event::end ? -1 : 0;
    }
}

} // namespace fascicle::io
