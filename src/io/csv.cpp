#include "fascicle/io/csv.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/base/param_table.hpp"
#include "io/formats/text_scanner.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle {

namespace {

constexpr std::string_view byte_order_mark = "\xef\xbb\xbf"; // of UTF-8

} // namespace

void CsvWriter::separate() {
    if (!first_)
        out_ << ',';
    first_ = false;
}

CsvWriter& CsvWriter::text(std::string_view cell) {
    separate();
    // Blanks at the ends would be taken off a cell without quotes, and a byte order mark off the first cell of all;
    // separators of other tables are better kept apart, too.
    if (cell.find_first_of(",;\t\"\r\n") == std::string_view::npos &&
        io::trimmed(cell).size() == cell.size() && !cell.starts_with(byte_order_mark)) {
        out_ << cell;
        return *this;
    }
    out_ << '"';
    for (const char c : cell) {
        if (c == '"')
            out_ << '"';
        out_ << c;
    }
    out_ << '"';
    return *this;
}

CsvWriter& CsvWriter::number(double value) {
    separate();
    out_ << number_text(value);
    return *this;
}

CsvWriter& CsvWriter::integer(long long value) {
    separate();
    out_ << std::to_string(value);
    return *this;
}

void CsvWriter::end_row() {
    out_ << '\n';
    first_ = true;
}

CsvReader::CsvReader(std::string_view bytes, std::string file) : bytes_(bytes), file_(std::move(file)) {
    if (bytes_.starts_with(byte_order_mark))
        position_ = byte_order_mark.size();
    const std::size_t start = bytes_.find_first_not_of(" \t\r\n", position_);
    if (start == std::string_view::npos)
        throw_error(file_, "the file is empty", "a header row with column names");
    const auto count = [&](char c) { // in the header, outside of quotes
        std::size_t found = 0;
        bool quoted = false;
        for (std::size_t i = start; i < bytes_.size(); ++i) {
            quoted = quoted != (bytes_[i] == '"');
            if (!quoted && (bytes_[i] == '\n' || bytes_[i] == '\r'))
                break;
            found += !quoted && bytes_[i] == c ? 1 : 0;
        }
        return found;
    };
    for (const char c : {';', '\t'})
        if (count(c) > count(separator_))
            separator_ = c;
    position_ = start;
    split_row();
    for (const std::string& cell : cells_)
        columns_.push_back(io::lower_case(cell));
}

int CsvReader::column(std::string_view name) const {
    const auto it = std::find(columns_.begin(), columns_.end(), name);
    return it == columns_.end() ? -1 : static_cast<int>(it - columns_.begin());
}

void CsvReader::split_row() {
    cells_.clear();
    row_start_ = position_;
    std::string cell;
    bool quoted = false, was_quoted = false;
    const auto end_cell = [&] {
        cells_.emplace_back(was_quoted ? std::string_view(cell) : io::trimmed(cell));
        cell.clear();
        was_quoted = false;
        if (!columns_.empty() && cells_.size() > columns_.size() && !cells_.back().empty())
            fail("row of more than " + std::to_string(columns_.size()) + " cells",
                 "as many as the header has");
    };
    for (; position_ < bytes_.size(); ++position_) {
        const char c = bytes_[position_];
        if (quoted) {
            if (c != '"')
                cell += c;
            else if (bytes_.substr(position_ + 1, 1) == "\"")
                cell += bytes_[++position_];
            else
                quoted = false;
        } else if (c == '"' && io::trimmed(cell).empty()) {
            quoted = was_quoted = true;
            cell.clear();
        } else if (c == separator_) {
            end_cell();
        } else if (c == '\n' || c == '\r') {
            position_ += bytes_.substr(position_, 2) == "\r\n" ? 2 : 1;
            end_cell();
            return;
        } else if (!was_quoted) {
            cell += c;
        } else if (c != ' ' && c != '\t') {
            fail("text after a closing quote", "the end of the cell");
        }
    }
    if (quoted)
        fail("a quote is not closed", "\"");
    end_cell();
}

bool CsvReader::next_row() {
    while (position_ < bytes_.size()) {
        split_row();
        if (std::any_of(cells_.begin(), cells_.end(), [](const std::string& cell) { return !cell.empty(); }))
            return true;
    }
    return false;
}

const std::string& CsvReader::cell(int column) const {
    static const std::string none;
    const auto index = static_cast<std::size_t>(column);
    return index < cells_.size() ? cells_[index] : none;
}

double CsvReader::number(int column) const {
    std::string text = cell(column);
    // A comma can only be a decimal sign here: where it separates cells it stands in none, unless quoted.
    if (text.find('.') == std::string::npos && std::count(text.begin(), text.end(), ',') == 1)
        std::replace(text.begin(), text.end(), ',', '.');
    double value = 0.0;
    if (io::to_double(text, value) != io::NumberCheck::ok || !std::isfinite(value))
        fail("got " + io::shown(cell(column)) + " in column " +
                 io::shown(columns_[static_cast<std::size_t>(column)]),
             "a number");
    return value;
}

void CsvReader::fail(const std::string& what, const std::string& expected) const {
    fail_at(row_start_, what, expected);
}

void CsvReader::fail_at(std::size_t place, const std::string& what, const std::string& expected) const {
    io::TextScanner(bytes_, file_).fail_at(place, what, expected);
}

std::string plain_column(std::string name) {
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == ' ' || c == '[' || c == '(' || c == '-'; }, '_');
    std::erase_if(name, [](char c) { return c == ']' || c == ')'; });
    name.erase(std::unique(name.begin(), name.end(), [](char a, char b) { return a == '_' && b == '_'; }),
               name.end());
    return name;
}

} // namespace fascicle
