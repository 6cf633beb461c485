#pragma once
// Comma-separated values: written for spreadsheets and scripts, read from what those write.

#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace fascicle {

/// Writes rows: comma, dot, LF, shortest numbers that read back the same, quotes where RFC 4180 wants them.
/// A number that is not finite is written as nan, inf or -inf.
class CsvWriter {
public:
    explicit CsvWriter(std::ostream& out) : out_(out) {}
    CsvWriter& text(std::string_view cell);
    CsvWriter& number(double value);
    CsvWriter& integer(long long value);
    void end_row();

private:
    void separate();
    std::ostream& out_;
    bool first_ = true;
};

/// Walks through the rows of a table with a header row: comma, semicolon or tab (what the header has most of), dot or
/// comma decimals, quoted cells, byte order mark, LF or CRLF. Empty rows, and rows of empty cells, are passed over.
class CsvReader {
public:
    /// Reads the header. `bytes` must outlive the reader; `file` is the name in messages. Error when there is no header.
    CsvReader(std::string_view bytes, std::string file);

    /// Column names, lower case, white space trimmed.
    const std::vector<std::string>& columns() const { return columns_; }
    /// Index of a column, or -1.
    int column(std::string_view name) const;

    /// Goes to the next row; false after the last. Error when it has more cells than the header.
    bool next_row();
    /// Cell of the row, trimmed; empty when the row ends before it.
    const std::string& cell(int column) const;
    /// Error naming line and column when the cell is not a finite number.
    double number(int column) const;
    /// Error at the row. "file, line 7: what; expected ..."
    [[noreturn]] void fail(const std::string& what, const std::string& expected = {}) const;
    /// Where the row begins, and an error at such a place, for what shows only when later rows are read.
    std::size_t row_place() const { return row_start_; }
    [[noreturn]] void fail_at(std::size_t place, const std::string& what,
                              const std::string& expected = {}) const;

private:
    /// Splits the next line (or lines: quoted cells may hold line ends) into cells_.
    void split_row();

    std::string_view bytes_;
    std::string file_;
    std::size_t position_ = 0;
    std::size_t row_start_ = 0;
    char separator_ = ',';
    std::vector<std::string> columns_;
    std::vector<std::string> cells_;
};

/// Column name with its unit as a suffix: "x [mm]", "x (mm)" and "x_mm" are the same name.
std::string plain_column(std::string name);

} // namespace fascicle
