#include "fascicle/io/storage_write.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/base/param_table.hpp"
#include "fascicle/io/csv.hpp"

namespace fascicle {

void write_storage(std::ostream& out, const StorageTable& table) {
    std::string name = table.name.empty() ? "table" : table.name;
    for (char& c : name)
        if (c == '\n' || c == '\r')
            c = ' ';
    if (name.starts_with("\xef\xbb\xbf")) // would be taken for the file's own mark, and be lost
        name.insert(0, 1, ' ');
    out << name << "\nversion=1\nnRows=" << table.row_count() << "\nnColumns=" << table.columns.size()
        << "\ninDegrees=" << (table.in_degrees ? "yes" : "no") << "\nendheader\n";
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
        if (table.columns[c].empty() || table.columns[c].find_first_of("\t\n\r") != std::string::npos)
            throw_error(table.file, "column " + std::to_string(c + 1) + " has a name that cannot be written",
                        "a name without tabs and line ends");
        out << (c == 0 ? "" : "\t") << table.columns[c];
    }
    // Without any tab blanks would separate names: one column whose name has blanks would come back as several.
    if (table.columns.size() == 1 && table.columns[0].find_first_of(" \v\f") != std::string::npos)
        out << '\t';
    out << '\n';
    for (std::size_t r = 0; r < table.row_count(); ++r)
        for (std::size_t c = 0; c < table.columns.size(); ++c)
            out << number_text(table.value(r, c)) << (c + 1 < table.columns.size() ? '\t' : '\n');
}

void write_storage_csv(std::ostream& out, const StorageTable& table) {
    CsvWriter csv(out);
    for (const std::string& column : table.columns)
        csv.text(column);
    csv.end_row();
    for (std::size_t r = 0; r < table.row_count(); ++r) {
        for (std::size_t c = 0; c < table.columns.size(); ++c)
            csv.number(table.value(r, c));
        csv.end_row();
    }
}

} // namespace fascicle
