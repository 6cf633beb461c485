#include "fascicle/io/storage_file.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/io/files.hpp"
#include "io/formats/text_scanner.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

namespace fascicle {
namespace {

using io::lower_case;
using io::shown;
using io::trimmed;

std::vector<std::string_view> words_of(std::string_view line) {
    std::vector<std::string_view> words;
    constexpr const char* space = " \t\r\v\f";
    for (std::size_t start = line.find_first_not_of(space); start != std::string_view::npos;) {
        const std::size_t end = std::min(line.find_first_of(space, start), line.size());
        words.push_back(line.substr(start, end - start));
        start = line.find_first_not_of(space, end);
    }
    return words;
}

std::vector<std::string> names_of(std::string_view line) {
    std::vector<std::string> names;
    if (line.find('\t') == std::string_view::npos) {
        for (const std::string_view word : words_of(line))
            names.emplace_back(word);
        return names;
    }
    while (!line.empty()) {
        const std::size_t end = std::min(line.find('\t'), line.size());
        if (const std::string_view name = trimmed(line.substr(0, end)); !name.empty())
            names.emplace_back(name);
        line.remove_prefix(std::min(end + 1, line.size()));
    }
    return names;
}

/// What the header says; counts are -1 when it does not.
struct Header {
    std::optional<bool> in_degrees;
    bool simm = false;
    bool says_degrees = false;
    long long rows = -1, columns = -1;
};

/// "nRows=51" or "datarows 51".
void read_header_line(std::string_view line, Header& header) {
    const std::string text = lower_case(trimmed(line));
    const std::size_t cut = text.find_first_of("= \t");
    const std::string key = text.substr(0, cut);
    std::string_view rest =
        cut == std::string::npos ? std::string_view{} : trimmed(std::string_view(text).substr(cut));
    if (rest.starts_with('='))
        rest = trimmed(rest.substr(1));
    const std::string value(rest);
    long long count = 0;
    const bool is_count = io::to_integer(value, count) == io::NumberCheck::ok && count >= 0;
    if (key == "indegrees")
        header.in_degrees = value == "yes" || value == "true" || value == "y" || value == "1";
    else if ((key == "nrows" || key == "datarows") && is_count)
        header.rows = count;
    else if ((key == "ncolumns" || key == "datacolumns") && is_count)
        header.columns = count;
    header.simm = header.simm || key == "datacolumns";
    header.says_degrees = header.says_degrees || text.find("angles are in degrees") != std::string::npos;
}

/// Reads up to the line of names. Returns that line.
std::string_view read_header(io::TextScanner& in, StorageTable& table, Header& header) {
    // A table without `endheader` must be told before its first row is taken for a header.
    const std::string_view bytes = in.bytes();
    const std::string text =
        lower_case(bytes.substr(0, std::min<std::size_t>(bytes.size(), std::size_t{1} << 20)));
    const bool has_end = text.find("endheader") != std::string::npos;
    bool first = true, ended = false;
    while (!in.at_end()) {
        const std::string_view line = in.next_line();
        const std::string_view plain = trimmed(line);
        if (plain.empty())
            continue;
        if (ended || (!has_end && lower_case(words_of(plain).front()) == "time"))
            return line;
        if (lower_case(plain) == "endheader") {
            ended = true;
            continue;
        }
        if (first)
            table.name = std::string(plain);
        first = false;
        read_header_line(line, header);
    }
    in.fail(ended ? "the file ends before the names of the columns" : "there is no header",
            "a line 'endheader', then the names of the columns, then rows of numbers");
}

void read_rows(io::TextScanner& in, StorageTable& table) {
    while (!in.at_end()) {
        const std::size_t place = in.position();
        const std::vector<std::string_view> words = words_of(in.next_line());
        if (words.empty())
            continue;
        if (words.size() != table.columns.size())
            in.fail("a row of " + std::to_string(words.size()) + " numbers",
                    std::to_string(table.columns.size()) + ", one for each column");
        for (std::size_t i = 0; i < words.size(); ++i) {
            double value = 0;
            if (io::to_double(words[i], value) != io::NumberCheck::ok)
                in.fail("column " + shown(table.columns[i]) + " is " + shown(words[i]), "a number");
            table.values.push_back(value);
        }
        table.lines.push_back(
            place); // bytes here, lines later: counting them for each row would be quadratic
    }
}

/// Bytes to lines, in one walk.
void number_lines(std::string_view bytes, std::vector<std::size_t>& places) {
    std::size_t line = 1, at = 0;
    for (std::size_t& place : places) {
        for (; at < place; ++at)
            if (bytes[at] == '\n' || (bytes[at] == '\r' && (at + 1 >= bytes.size() || bytes[at + 1] != '\n')))
                ++line;
        place = line;
    }
}

} // namespace

int StorageTable::column_index(const std::string& wanted) const {
    const auto it = std::find(columns.begin(), columns.end(), wanted);
    return it == columns.end() ? -1 : static_cast<int>(it - columns.begin());
}

StorageTable read_storage(std::string_view bytes, const std::string& file) {
    if (bytes.starts_with("\xef\xbb\xbf"))
        bytes.remove_prefix(3);
    io::TextScanner in(bytes, file);
    StorageTable table;
    table.file = file;
    Header header;
    table.columns = names_of(read_header(in, table, header));
    if (table.columns.empty())
        in.fail("no names of columns", "names between tabs or blanks");
    std::set<std::string> seen, twice;
    for (const std::string& name : table.columns)
        if (!seen.insert(name).second && twice.insert(name).second)
            table.notes.push_back("several columns are called " + shown(name) + ": the first one counts");
    table.in_degrees = header.in_degrees.value_or(header.says_degrees || header.simm);
    if (!header.in_degrees)
        table.notes.emplace_back(table.in_degrees
                                     ? "the header does not say inDegrees: angles are taken for degrees"
                                     : "the header does not say inDegrees: angles are taken for radians");
    read_rows(in, table);
    if (table.lines.empty())
        in.fail("the table has no rows", "rows of numbers below the names of the columns");
    number_lines(bytes, table.lines);
    const auto compare = [&](long long said, std::size_t found, const char* what) {
        if (said >= 0 && said != static_cast<long long>(found))
            table.notes.push_back("the header says " + std::to_string(said) + " " + what + ", there are " +
                                  std::to_string(found));
    };
    compare(header.rows, table.row_count(), "rows");
    compare(header.columns, table.columns.size(), "columns");
    return table;
}

StorageTable read_storage_file(const std::filesystem::path& path) {
    return read_storage(read_file(path, std::size_t{256} << 20), path.string());
}

CoordinateColumns match_coordinates(const StorageTable& table, const Skeleton& skeleton) {
    CoordinateColumns match;
    match.column_of.assign(skeleton.coordinates.size(), -1);
    std::string nobody;
    bool any = false;
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
        std::string name = table.columns[c];
        if (name.starts_with('/') && name.ends_with("/value"))
            name.erase(name.size() - 6);
        name = name.substr(name.find_last_of('/') + 1);
        const int coordinate = skeleton.coordinate_index(name);
        if (coordinate >= 0) {
            if (match.column_of[static_cast<std::size_t>(coordinate)] >= 0)
                throw_error(table.file, "two columns are coordinate '" + name + "'", "one for each");
            match.column_of[static_cast<std::size_t>(coordinate)] = static_cast<int>(c);
            any = true;
        } else if (c > 0 || lower_case(name) != "time") {
            nobody += (nobody.empty() ? "" : ", ") + name;
        }
    }
    if (!any)
        throw_error(table.file, "no column is a coordinate of the model",
                    skeleton.coordinates.empty() ? "a model with coordinates"
                                                 : "names such as " + skeleton.coordinates.front().name);
    std::string defaults;
    for (std::size_t i = 0; i < match.column_of.size(); ++i)
        if (match.column_of[i] < 0)
            defaults += (defaults.empty() ? "" : ", ") + skeleton.coordinates[i].name;
    if (!defaults.empty())
        match.notes.push_back("not in the motion, so at the model's default: " + defaults);
    if (!nobody.empty())
        match.notes.push_back("columns of the motion that are no coordinates: " +
                              (nobody.size() > 200 ? nobody.substr(0, 200) + " ..." : nobody));
    return match;
}

void coordinate_values(const StorageTable& table, const CoordinateColumns& columns, std::size_t row,
                       const Skeleton& skeleton, std::vector<double>& values) {
    values.resize(skeleton.coordinates.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const Coordinate& coordinate = skeleton.coordinates[i];
        if (columns.column_of[i] < 0) {
            values[i] = coordinate.default_value;
            continue;
        }
        const double value = table.value(row, static_cast<std::size_t>(columns.column_of[i]));
        if (!std::isfinite(value) || std::abs(value) > 1e6)
            throw_error(table.file + ", line " + std::to_string(table.lines[row]),
                        "coordinate '" + coordinate.name + "' is out of range", "a number from -1e6 to 1e6");
        const bool turns = table.in_degrees && coordinate.kind == CoordinateKind::rotational;
        values[i] = turns ? value * std::numbers::pi / 180 : value;
    }
}

} // namespace fascicle
