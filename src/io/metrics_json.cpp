#include "fascicle/io/metrics_json.hpp"

#include "fascicle/io/csv.hpp"
#include "fascicle/io/files.hpp"
#include "io/formats/text_scanner.hpp"
#include "io/json_fields.hpp"

#include <cmath>

namespace fascicle {
namespace fs = std::filesystem;

namespace {

io::Json rows_of(const fs::path& file) {
    const std::string bytes = read_file(file);
    CsvReader csv(bytes, file.string());
    io::Json rows = io::Json::array();
    while (csv.next_row()) {
        io::Json row = io::Json::object();
        for (std::size_t c = 0; c < csv.columns().size(); ++c) {
            const std::string& cell = csv.cell(static_cast<int>(c));
            double value = 0;
            long long whole = 0;
            // A muscle may be called "1": names stay texts.
            if (csv.columns()[c] == "muscle")
                row[csv.columns()[c]] = cell;
            else if (io::to_integer(cell, whole) == io::NumberCheck::ok)
                row[csv.columns()[c]] = whole;
            else if (io::to_double(cell, value) != io::NumberCheck::ok)
                row[csv.columns()[c]] = cell;
            else
                row[csv.columns()[c]] = std::isfinite(value) ? io::Json(value) : io::Json(nullptr);
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

} // namespace

std::string metrics_json(const fs::path& run) {
    io::Json json{{"format", "fascicle metrics"}, {"version", 1}};
    const fs::path summary = run / "summary.json";
    json["run"] = io::parse_json_object(read_file(summary), summary.string());
    json["metrics"] = rows_of(run / "metrics.csv");
    std::error_code error;
    if (fs::exists(run / "fibres.csv", error))
        json["fibres"] = rows_of(run / "fibres.csv");
    // A row a line, so that it can be looked at and compared.
    std::string out = "{";
    for (const auto& [key, value] : json.items()) {
        out += (out.size() > 1 ? ",\n" : "\n") + io::Json(key).dump() + ": ";
        if (!value.is_array()) {
            out += value.dump(-1, ' ', false, io::Json::error_handler_t::replace);
            continue;
        }
        out += "[";
        bool first = true;
        for (const io::Json& row : value) {
            out += first ? "\n" : ",\n";
            out += row.dump(-1, ' ', false, io::Json::error_handler_t::replace);
            first = false;
        }
        out += "\n]";
    }
    return out + "\n}\n";
}

} // namespace fascicle
