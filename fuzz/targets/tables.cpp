// Tables of comma-separated values.

#include "fascicle/io/attachment_file.hpp"
#include "fascicle/io/csv.hpp"
#include "fuzz/check.hpp"
#include "fuzz/targets.hpp"

#include <cmath>
#include <sstream>

namespace fascicle::fuzz {
namespace {

/// Without empty cells at the end of a row: a short file of many columns may have many rows of one cell.
using Rows = std::vector<std::vector<std::string>>;

const std::string& cell_of(const std::vector<std::string>& row, std::size_t column) {
    static const std::string none;
    return column < row.size() ? row[column] : none;
}

Rows all_rows(std::string_view bytes, const std::string& name) {
    CsvReader csv(bytes, name);
    Rows rows;
    rows.push_back(csv.columns());
    while (csv.next_row()) {
        int cells = static_cast<int>(csv.columns().size());
        while (cells > 0 && csv.cell(cells - 1).empty())
            --cells;
        std::vector<std::string>& row = rows.emplace_back();
        row.reserve(static_cast<std::size_t>(cells));
        for (int c = 0; c < cells; ++c)
            row.push_back(csv.cell(c));
    }
    return rows;
}

/// Whether a table has these rows; one at a time, so that memory is the reader's, not that of a second copy.
bool has_rows(std::string_view bytes, const Rows& rows) {
    CsvReader csv(bytes, "written");
    if (csv.columns() != rows.front())
        return false;
    std::size_t row = 1;
    for (; csv.next_row(); ++row) {
        if (row == rows.size() || rows[row].size() > csv.columns().size())
            return false;
        for (std::size_t c = 0; c < csv.columns().size(); ++c)
            if (csv.cell(static_cast<int>(c)) != cell_of(rows[row], c))
                return false;
    }
    return row == rows.size();
}

void fuzz_csv(std::string_view bytes) {
    Rows rows;
    if (!reads("fuzz.csv", [&] { rows = all_rows(bytes, "fuzz.csv"); }))
        return;
    std::ostringstream out;
    CsvWriter csv(out);
    for (const auto& row : rows) {
        for (std::size_t c = 0; c < rows.front().size(); ++c)
            csv.text(cell_of(row, c));
        csv.end_row();
    }
    const std::string text = std::move(out).str();
    bool names = false; // a header without a name is no header
    for (const std::string& name : rows.front())
        names = names || !name.empty();
    if (names)
        FUZZ_CHECK(has_rows(text, rows));
    reads("fuzz.csv", [&] {
        CsvReader numbers(bytes, "fuzz.csv");
        while (numbers.next_row())
            for (int c = 0; c < static_cast<int>(numbers.columns().size()); ++c)
                FUZZ_CHECK(std::isfinite(numbers.number(c)));
    });
    for (const std::string& name : rows.front())
        plain_column(name);
}

void fuzz_attachment_csv(std::string_view bytes) {
    for (const LengthUnit unit : {LengthUnit::millimetre, LengthUnit::metre})
        reads("fuzz.csv", [&] {
            const std::vector<AttachmentOutline> outlines = read_attachments(bytes, "fuzz.csv", unit);
            FUZZ_CHECK(!outlines.empty());
            for (const AttachmentOutline& outline : outlines) {
                FUZZ_CHECK(outline.kind != AttachmentKind::unknown && !outline.bone.empty());
                FUZZ_CHECK(!outline.points.empty());
                for (const Vec3& p : outline.points)
                    FUZZ_CHECK(p.allFinite());
            }
        });
}

} // namespace

std::vector<Target> table_targets() {
    return {
        {"csv", fuzz_csv, 1 * kB, "csv", "csv", 400, MB},
        {"attachment_csv", fuzz_attachment_csv, 2 * kB, "attachment_csv", "attachment_csv", 400, MB},
    };
}

} // namespace fascicle::fuzz
