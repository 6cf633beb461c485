#pragma once
// Walks through the text of a file: words, lines, numbers, and errors that name the place. Independent of the
// locale.

#include <cstddef>
#include <string>
#include <string_view>

namespace fascicle::io {

/// More points, triangles or indices than this in one file is refused: indices must fit an int, three times
/// over.
inline constexpr std::size_t max_elements = std::size_t{1} << 28;

/// A piece of a file, fit to stand in a message: short, and printable.
std::string shown(std::string_view text);

/// ASCII only, whatever the locale.
std::string lower_case(std::string_view text);
bool equal_ignoring_case(std::string_view a, std::string_view b);
std::string_view trimmed(std::string_view text);

enum class NumberCheck { ok, not_a_number, out_of_range };
/// Whole text as a double, a leading '+' allowed. "nan" and "inf" are numbers here: callers tell where they
/// stand. Too small to be a double counts as 0, too large as out of range.
NumberCheck to_double(std::string_view text, double& value);
NumberCheck to_integer(std::string_view text, long long& value);

class TextScanner {
public:
    /// `bytes` must outlive the scanner. `file` is the name in messages.
    TextScanner(std::string_view bytes, std::string file) : bytes_(bytes), file_(std::move(file)) {}

    std::size_t position() const { return position_; }
    void move_to(std::size_t position) { position_ = position; }
    std::size_t remaining() const { return bytes_.size() - position_; }
    bool at_end() const { return position_ >= bytes_.size(); }
    std::string_view bytes() const { return bytes_; }
    const std::string& file() const { return file_; }
    /// Messages name the byte instead of the line.
    void name_bytes() { names_bytes_ = true; }

    void skip_space();
    /// Next word between white space; empty at the end of the file.
    std::string_view next_word();
    std::string_view peek_word();
    /// Rest of the line without its end ("\n", "\r\n" or a lone "\r"), which is passed over.
    std::string_view next_line();

    /// Next word as a number. Error naming `what` when it is none.
    double next_double(const char* what);
    long long next_integer(const char* what);
    /// Next word as a count from 0 to max_elements.
    std::size_t next_count(const char* what);

    /// Line of a byte, from 1.
    std::size_t line_of(std::size_t position) const;
    /// "file, line 7" or "file, byte 123".
    std::string where(std::size_t position) const;
    /// Error at the start of the last word or line read.
    [[noreturn]] void fail(const std::string& what, const std::string& expected = {}) const;
    [[noreturn]] void fail_at(std::size_t position, const std::string& what,
                              const std::string& expected = {}) const;

private:
    std::string_view bytes_;
    std::string file_;
    std::size_t position_ = 0;
    std::size_t last_ = 0;
    bool names_bytes_ = false;
};

} // namespace fascicle::io
