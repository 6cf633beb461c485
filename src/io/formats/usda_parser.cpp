#include "io/formats/usda_parser.hpp"

#include <cmath>

namespace fascicle::io {

namespace {

constexpr int deepest = 50;
constexpr std::size_t most_prims = 100000, most_attributes = 1000000;

bool is_word(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == ':' || c == '!' || c == '.' || static_cast<unsigned char>(c) >= 0x80;
}

class Parser {
public:
    Parser(std::string_view bytes, const std::string& file) : bytes_(bytes), scanner_(bytes, file) {}

    UsdaLayer layer() {
        at_ = std::min(bytes_.find_first_not_of(" \t\r\n"), bytes_.size());
        if (bytes_.substr(at_, 5) != "#usda")
            fail("not USD text", "#usda 1.0 (binary .usdc and packed .usdz: usdcat --out FILE.usda)");
        UsdaLayer out;
        skip();
        if (peek() == '(')
            metadata(out.metadata);
        for (skip(); at_ < bytes_.size(); skip())
            out.prims.push_back(prim(1));
        return out;
    }

private:
    [[noreturn]] void fail(const std::string& what, const std::string& expected = {}) const {
        scanner_.fail_at(std::min(at_, bytes_.size()), what, expected);
    }
    char peek() const { return at_ < bytes_.size() ? bytes_[at_] : '\0'; }
    /// White space, comments, and the semicolons that may stand for line ends.
    void skip() {
        while (at_ < bytes_.size()) {
            const char c = bytes_[at_];
            if (c == '#')
                while (at_ < bytes_.size() && bytes_[at_] != '\n')
                    ++at_;
            else if (c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == ';')
                ++at_;
            else
                return;
        }
    }
    bool take(char c) {
        skip();
        if (peek() != c || at_ >= bytes_.size())
            return false;
        ++at_;
        return true;
    }
    void want(char c) {
        if (!take(c))
            fail(at_ >= bytes_.size() ? "the file ends" : "got " + shown(bytes_.substr(at_, 12)),
                 std::string(1, c));
    }
    std::string word() {
        skip();
        const std::size_t start = at_;
        while (at_ < bytes_.size() && is_word(bytes_[at_]))
            ++at_;
        if (at_ == start)
            fail(at_ >= bytes_.size() ? "the file ends" : "got " + shown(bytes_.substr(at_, 12)), "a name");
        return std::string(bytes_.substr(start, at_ - start));
    }
    std::string quoted();
    std::string enclosed(char open, char close);
    void value(UsdaValue& out, int depth);
    void metadata(std::map<std::string, UsdaValue>& out);
    void attribute(UsdaPrim& prim);
    std::unique_ptr<UsdaPrim> prim(int depth);

    std::string_view bytes_;
    TextScanner scanner_;
    std::size_t at_ = 0, prims_ = 0, attributes_ = 0;
};

std::string Parser::quoted() {
    const char mark = peek();
    const bool triple = bytes_.substr(at_, 3) == std::string(3, mark);
    at_ += triple ? 3 : 1;
    std::string out;
    for (;; ++at_) {
        if (at_ >= bytes_.size() || (!triple && bytes_[at_] == '\n'))
            fail("a text without its end", std::string(triple ? 3 : 1, mark));
        if (bytes_[at_] == '\\' && at_ + 1 < bytes_.size()) {
            const char c = bytes_[++at_];
            out += c == 'n' ? '\n' : c == 't' ? '\t' : c;
        } else if (triple ? bytes_.substr(at_, 3) == std::string(3, mark) : bytes_[at_] == mark) {
            at_ += triple ? 3 : 1;
            return out;
        } else {
            out += bytes_[at_];
        }
    }
}

std::string Parser::enclosed(char open, char close) {
    want(open);
    const std::size_t end = bytes_.find(close, at_);
    if (end == std::string_view::npos)
        fail("a path without its end", std::string(1, close));
    std::string out(bytes_.substr(at_, end - at_));
    at_ = end + 1;
    return out;
}

void Parser::value(UsdaValue& out, int depth) {
    if (depth > deepest)
        fail("brackets nested too deeply", "at most " + std::to_string(deepest) + " levels");
    skip();
    const char c = peek();
    if (c == '[' || c == '(') {
        const char close = c == '[' ? ']' : ')';
        ++at_;
        while (!take(close)) {
            value(out, depth + 1);
            if (!take(',')) {
                want(close);
                return;
            }
        }
    } else if (c == '"' || c == '\'') {
        out.texts.push_back(quoted());
    } else if (c == '@') {
        out.texts.push_back(enclosed('@', '@'));
    } else if (c == '<') {
        out.texts.push_back(enclosed('<', '>'));
    } else if (c == '{') { // a dictionary: passed over, but its texts
        ++at_;
        while (!take('}')) {
            word(); // type
            skip();
            if (peek() == '[') { // string[]
                want('['), want(']');
                skip();
            }
            if (peek() == '"' || peek() == '\'')
                quoted();
            else
                word();
            want('=');
            value(out, depth + 1);
            take(',');
        }
    } else {
        const std::size_t start = at_;
        if (c == '-' || c == '+')
            ++at_;
        const auto goes_on = [&] {
            const char next = peek(), last = at_ > start ? bytes_[at_ - 1] : ' ';
            return at_ < bytes_.size() && next != ':' && // which ends the time of a sample
                   (is_word(next) || ((next == '-' || next == '+') && (last == 'e' || last == 'E')));
        };
        while (goes_on())
            ++at_;
        const std::string_view text = bytes_.substr(start, at_ - start);
        double number = 0;
        if (!text.empty() && to_double(text, number) == NumberCheck::ok)
            out.numbers.push_back(number);
        else if (text == "true" || text == "false")
            out.numbers.push_back(text == "true");
        else if (text == "None")
            return;
        else {
            at_ = start;
            fail(start >= bytes_.size() ? "the file ends" : "got " + shown(bytes_.substr(start, 12)),
                 "a value");
        }
    }
}

/// ( key = value ... ), with texts between them, which are comments.
void Parser::metadata(std::map<std::string, UsdaValue>& out) {
    want('(');
    while (!take(')')) {
        skip();
        if (peek() == '"' || peek() == '\'') {
            quoted();
            continue;
        }
        std::string key = word();
        for (const char* edit : {"prepend", "append", "add", "delete", "reorder"})
            if (key == edit) {
                key = word();
                break;
            }
        for (const char* foreign :
             {"references", "payload", "inherits", "specializes", "variantSets", "variants", "subLayers"})
            if (key == foreign)
                fail("it needs " + key + ", which are not read",
                     "one layer that holds everything (usdcat --flatten)");
        want('=');
        value(out[key], 1);
    }
}

void Parser::attribute(UsdaPrim& prim) {
    const std::size_t place = at_;
    std::string type = word();
    while (type == "custom" || type == "uniform" || type == "varying" || type == "config" ||
           type == "prepend" || type == "append" || type == "add" || type == "delete" || type == "reorder")
        type = word();
    if (type == "variantSet")
        fail("it has variants, which are not read", "one layer that holds everything (usdcat --flatten)");
    if (take('[')) {
        want(']');
        type += "[]";
    }
    std::string name = word();
    const auto ends_with = [&](std::string_view end) {
        if (name.size() < end.size() || name.compare(name.size() - end.size(), end.size(), end) != 0)
            return false;
        name.resize(name.size() - end.size());
        return true;
    };
    if (++attributes_ > most_attributes)
        fail("too many attributes", "at most " + std::to_string(most_attributes));
    const bool connects = ends_with(".connect"), sampled = ends_with(".timeSamples");
    UsdaAttribute& attribute = prim.attributes[name];
    attribute.type = type;
    attribute.place = place;
    if (take('=')) {
        if (sampled) {
            want('{');
            while (!take('}')) {
                UsdaValue time;
                value(time, 1);
                if (time.numbers.size() != 1 || !std::isfinite(time.numbers[0]))
                    fail("a bad time", "a number before the colon");
                want(':');
                value(attribute.samples[time.numbers[0]], 1);
                take(',');
            }
        } else if (connects) {
            UsdaValue target;
            value(target, 1);
        } else {
            attribute.value = {};
            value(attribute.value, 1);
        }
    }
    skip();
    if (peek() == '(') {
        std::map<std::string, UsdaValue> about;
        metadata(about);
    }
}

std::unique_ptr<UsdaPrim> Parser::prim(int depth) {
    if (depth > deepest)
        fail("prims nested too deeply", "at most " + std::to_string(deepest) + " levels");
    if (++prims_ > most_prims)
        fail("too many prims", "at most " + std::to_string(most_prims));
    auto out = std::make_unique<UsdaPrim>();
    skip();
    out->place = at_;
    const std::string specifier = word();
    if (specifier != "def") {
        at_ = out->place;
        fail("got " + shown(specifier), "def; over and class need other layers (usdcat --flatten)");
    }
    skip();
    if (peek() != '"')
        out->type = word();
    skip();
    if (peek() != '"')
        fail("got " + shown(bytes_.substr(std::min(at_, bytes_.size()), 12)), "the prim's name in quotes");
    out->name = quoted();
    skip();
    if (peek() == '(')
        metadata(out->metadata);
    want('{');
    while (!take('}')) {
        skip();
        const std::size_t start = at_;
        const std::string first = word();
        at_ = start;
        if (first == "def" || first == "over" || first == "class")
            out->children.push_back(prim(depth + 1));
        else
            attribute(*out);
    }
    return out;
}

} // namespace

UsdaLayer parse_usda(std::string_view bytes, const std::string& file) {
    return Parser(bytes, file).layer();
}

} // namespace fascicle::io
