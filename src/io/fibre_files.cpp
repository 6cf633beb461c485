#include "fascicle/io/fibre_files.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/io/csv.hpp"
#include "fascicle/io/files.hpp"
#include "io/own_table.hpp"
#include "io/run_files.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fascicle {

namespace {

bool all_finite(const std::vector<double>& values) {
    return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

void add_array(std::vector<NamedArray>& arrays, std::string name, int components,
               std::vector<double> values) {
    if (all_finite(values))
        arrays.push_back({std::move(name), components, std::move(values)});
}

/// Lines, fibre_id and tangents.
MeshData lines_of(const FibreSet& fibres) {
    MeshData data;
    data.lines.points = fibres.points;
    std::vector<double> ids, tangents;
    const int points = fibres.segments + 1;
    for (int f = 0; f < fibres.count; ++f) {
        std::vector<int>& line = data.lines.lines.emplace_back();
        for (int j = 0; j < points; ++j)
            line.push_back(f * points + j);
        ids.push_back(f);
    }
    for (const Vec3& t : fibre_tangents(fibres))
        tangents.insert(tangents.end(), {t.x(), t.y(), t.z()});
    add_array(data.line_arrays, "fibre_id", 1, std::move(ids));
    add_array(data.point_arrays, "tangent", 3, std::move(tangents));
    return data;
}

} // namespace

void write_fibre_table(const std::filesystem::path& path, const std::vector<const FibreSeries*>& series) {
    AtomicFile file(path);
    CsvWriter csv(file.stream());
    csv.text("frame").text("muscle").text("fibre").text("angle_deg");
    for (const FibreQuantityRow& row : fibre_quantities())
        csv.text(row.key);
    csv.end_row();
    const int frames = series.empty() ? 0 : series.front()->frame_count();
    for (const FibreSeries* s : series)
        FASCICLE_ASSERT(s->frame_count() == frames);
    for (int k = 0; k < frames; ++k)
        for (const FibreSeries* s : series) {
            FASCICLE_ASSERT(s->frame(k) == series.front()->frame(k));
            for (int f = 0; f < s->fibre_count(); ++f) {
                csv.integer(s->frame(k)).text(s->muscle()).integer(f);
                csv.number(s->angle_rad(k) * 180.0 / std::numbers::pi);
                for (const FibreQuantityRow& row : fibre_quantities())
                    csv.number(s->value(row.quantity, k, f));
                csv.end_row();
            }
        }
    file.commit();
}

void remove_fibre_table(const std::filesystem::path& path) {
    io::remove_own_table(path, "frame,muscle,fibre,angle_deg,");
}

MeshData fibre_lines(const FibreSeries& series, int frame, const FibreSet& fibres) {
    const int k = series.index_of(frame);
    FASCICLE_ASSERT(k >= 0 && fibres.count == series.fibre_count());
    MeshData data = lines_of(fibres);
    for (const FibreQuantityRow& row : fibre_quantities())
        add_array(data.line_arrays, row.key, 1, series.values(row.quantity, k));
    add_array(data.point_arrays, "stretch", 1, point_stretch(fibres, series.rest()));
    return data;
}

MeshData fibre_lines(const FibreSet& fibres, double unit_mm) {
    MeshData data = lines_of(fibres);
    std::vector<double> lengths = fibre_lengths(fibres);
    for (double& length : lengths)
        length *= unit_mm;
    add_array(data.line_arrays, "length_mm", 1, std::move(lengths));
    return data;
}

std::filesystem::path fibre_file(std::string_view muscle, int frame) {
    return std::filesystem::path("fibres") / io::frame_file(muscle, frame).filename();
}

} // namespace fascicle
