#include "io/formats/text_scanner.hpp"

#include "fascicle/base/error.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

namespace fascicle::io {
namespace {

bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v';
}

/// Whether a number that does not fit a double is too small rather than too large: a negative exponent, or no
/// digit but 0 before the point and no exponent.
bool is_tiny(std::string_view text) {
    const std::size_t e = text.find_first_of("eE");
    if (e != std::string_view::npos)
        return e + 1 < text.size() && text[e + 1] == '-';
    return text.substr(0, text.find('.')).find_first_of("123456789") == std::string_view::npos;
}

} // namespace

std::string shown(std::string_view text) {
    constexpr std::size_t longest = 40;
    std::string out(text.substr(0, longest));
    for (char& c : out)
        if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7f)
            c = '?';
    return "'" + out + (text.size() > longest ? "...'" : "'");
}

std::string lower_case(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        if (c >= 'A' && c <= 'Z')
            c = static_cast<char>(c - 'A' + 'a');
    return out;
}

bool equal_ignoring_case(std::string_view a, std::string_view b) {
    return a.size() == b.size() && lower_case(a) == lower_case(b);
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_space(text.front()))
        text.remove_prefix(1);
    while (!text.empty() && is_space(text.back()))
        text.remove_suffix(1);
    return text;
}

NumberCheck to_double(std::string_view text, double& value) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+')
        text.remove_prefix(1);
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end != text.data() + text.size() || text.empty())
        return NumberCheck::not_a_number;
    if (code == std::errc::result_out_of_range) {
        if (!is_tiny(text))
            return NumberCheck::out_of_range;
        value = 0.0;
        return NumberCheck::ok;
    }
    return code == std::errc{} ? NumberCheck::ok : NumberCheck::not_a_number;
}

NumberCheck to_integer(std::string_view text, long long& value) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-')
        text.remove_prefix(1);
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end != text.data() + text.size() || text.empty())
        return NumberCheck::not_a_number;
    if (code == std::errc::result_out_of_range)
        return NumberCheck::out_of_range;
    return code == std::errc{} ? NumberCheck::ok : NumberCheck::not_a_number;
}

void TextScanner::skip_space() {
    while (position_ < bytes_.size() && is_space(bytes_[position_]))
        ++position_;
}

std::string_view TextScanner::next_word() {
    skip_space();
    last_ = position_;
    while (position_ < bytes_.size() && !is_space(bytes_[position_]))
        ++position_;
    return bytes_.substr(last_, position_ - last_);
}

std::string_view TextScanner::peek_word() {
    const std::size_t position = position_, last = last_;
    const std::string_view word = next_word();
    position_ = position;
    last_ = last;
    return word;
}

std::string_view TextScanner::next_line() {
    last_ = position_;
    while (position_ < bytes_.size() && bytes_[position_] != '\n' && bytes_[position_] != '\r')
        ++position_;
    const std::string_view line = bytes_.substr(last_, position_ - last_);
    if (position_ < bytes_.size())
        position_ += bytes_.substr(position_, 2) == "\r\n" ? 2 : 1;
    return line;
}

double TextScanner::next_double(const char* what) {
    const std::string_view word = next_word();
    double value = 0.0;
    if (to_double(word, value) != NumberCheck::ok)
        fail(word.empty() ? "the file ends too early" : "got " + shown(word), what);
    return value;
}

long long TextScanner::next_integer(const char* what) {
    const std::string_view word = next_word();
    long long value = 0;
    if (to_integer(word, value) != NumberCheck::ok)
        fail(word.empty() ? "the file ends too early" : "got " + shown(word), what);
    return value;
}

std::size_t TextScanner::next_count(const char* what) {
    const std::string_view word = next_word();
    long long value = 0;
    if (to_integer(word, value) != NumberCheck::ok || value < 0 ||
        static_cast<std::size_t>(value) > max_elements)
        fail(word.empty() ? "the file ends too early" : "got " + shown(word),
             std::string(what) + ", from 0 to " + std::to_string(max_elements));
    return static_cast<std::size_t>(value);
}

std::size_t TextScanner::line_of(std::size_t position) const {
    std::size_t line = 1;
    for (std::size_t i = 0; i < std::min(position, bytes_.size()); ++i)
        if (bytes_[i] == '\n' || (bytes_[i] == '\r' && bytes_.substr(i, 2) != "\r\n"))
            ++line;
    return line;
}

std::string TextScanner::where(std::size_t position) const {
    return file_ + (names_bytes_ ? ", byte " + std::to_string(position)
                                 : ", line " + std::to_string(line_of(position)));
}

void TextScanner::fail(const std::string& what, const std::string& expected) const {
    fail_at(last_, what, expected);
}

void TextScanner::fail_at(std::size_t position, const std::string& what, const std::string& expected) const {
    throw_error(where(position), what, expected);
}

} // namespace fascicle::io
