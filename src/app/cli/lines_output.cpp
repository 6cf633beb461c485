#include "app/cli/lines_output.hpp"

#include "fascicle/base/text.hpp"
#include "fascicle/io/csv.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/mesh_stamp.hpp"
#include "io/formats/pvd.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <ostream>

namespace fascicle::app {
namespace {

constexpr double degrees_per_radian = 180 / std::numbers::pi;

struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    void add(double x) {
        low = std::min(low, x);
        high = std::max(high, x);
    }
};

std::string to_text(const Range& range) {
    char buffer[80];
    std::snprintf(buffer, sizeof buffer, "%7.1f .. %7.1f", range.low, range.high);
    return buffer;
}

bool has_strings(const LinesResult& result) {
    return !result.rows.empty() && result.rows.front().string.has_value();
}

/// One file a frame; `points_of`: the polyline of a row.
template <class PointsOf>
void write_series(const std::filesystem::path& folder, const std::string& name, std::size_t muscles,
                  const LinesResult& result, const PointsOf& points_of) {
    std::vector<std::pair<double, std::string>> series;
    for (std::size_t frame = 0; frame < result.times.size(); ++frame) {
        MeshData data;
        NamedArray number{"muscle", 1, {}};
        for (std::size_t m = 0; m < muscles; ++m) {
            std::vector<int> line;
            for (const Vec3& x : points_of(result.rows[frame * muscles + m])) {
                line.push_back(static_cast<int>(data.lines.points.size()));
                data.lines.points.push_back(x);
            }
            data.lines.lines.push_back(std::move(line));
            number.values.push_back(static_cast<double>(m));
        }
        data.line_arrays.push_back(std::move(number));
        char file[64];
        std::snprintf(file, sizeof file, "%s.%04zu.vtp", name.c_str(), frame);
        write_stamped_file(folder / "frames" / file, data, stamp_of(LengthUnit::metre));
        series.emplace_back(result.times[frame], std::string("frames/") + file);
    }
    AtomicFile index(folder / (name + ".pvd"));
    io::write_pvd(index.stream(), series);
    index.commit();
}

} // namespace

void write_lines_csv(const std::filesystem::path& folder, const LineModel& model, const LinesResult& result) {
    AtomicFile file(folder / "lines.csv");
    CsvWriter csv(file.stream());
    const bool arms = result.coordinate >= 0, strings = has_strings(result);
    csv.text("frame").text("muscle");
    if (arms)
        csv.text(model.skeleton.coordinates[static_cast<std::size_t>(result.coordinate)].name + "_deg");
    csv.text("length_mm");
    if (arms)
        csv.text("moment_arm_mm");
    if (strings) {
        csv.text("string_length_mm");
        if (arms)
            csv.text("string_moment_arm_mm");
        csv.text("string_clear");
    }
    csv.end_row();
    const std::size_t muscles = model.muscles.size();
    for (std::size_t i = 0; i < result.rows.size(); ++i) {
        const LinesRow& row = result.rows[i];
        csv.integer(static_cast<long long>(i / muscles)).text(model.muscles[i % muscles].name);
        if (arms)
            csv.number(row.coordinate_value * degrees_per_radian);
        csv.number(1000 * row.line.length);
        if (arms)
            csv.number(1000 * row.line.moment_arm);
        if (strings) {
            csv.number(1000 * row.string->path.length);
            if (arms)
                csv.number(1000 * row.string->moment_arm);
            csv.integer(row.string->path.clear ? 1 : 0);
        }
        csv.end_row();
    }
    file.commit();
}

void write_lines_vtp(const std::filesystem::path& folder, const LineModel& model, const LinesResult& result) {
    const std::size_t muscles = model.muscles.size();
    write_series(folder, "lines", muscles, result, [](const LinesRow& row) { return row.line.polyline; });
    if (has_strings(result))
        write_series(folder, "strings", muscles, result,
                     [](const LinesRow& row) { return row.string->path.points; });
}

void print_lines(std::ostream& out, const LineModel& model, const LinesResult& result) {
    constexpr std::size_t most_lines = 12;
    const std::size_t muscles = model.muscles.size();
    out << one_line(model.name) << ": " << model.skeleton.bodies.size() - 1 << " bodies, "
        << model.skeleton.coordinates.size() << " coordinates, " << muscles << " muscles, "
        << result.times.size() << " frames\n";
    for (const std::string& note : result.notes)
        out << "note: " << one_line(note) << '\n';
    const bool strings = has_strings(result);
    std::size_t width = 6, buried = 0;
    for (std::size_t m = 0; m < std::min(muscles, most_lines); ++m)
        width = std::max(width, model.muscles[m].name.size());
    const auto padded = [&](std::string text, std::size_t size) {
        text.resize(std::max(size, text.size()), ' ');
        return text;
    };
    out << padded("muscle", width) << "  " << padded("length mm", 18);
    if (result.coordinate >= 0)
        out << "  moment arm mm about "
            << model.skeleton.coordinates[static_cast<std::size_t>(result.coordinate)].name
            << (strings ? ", as a string over the bones" : "");
    else if (strings)
        out << "  as a string over the bones";
    out << '\n';
    for (std::size_t m = 0; m < std::min(muscles, most_lines); ++m) {
        Range length, arm, string;
        for (std::size_t frame = 0; frame < result.times.size(); ++frame) {
            const LinesRow& row = result.rows[frame * muscles + m];
            length.add(1000 * row.line.length);
            arm.add(1000 * row.line.moment_arm);
            if (strings)
                string.add(1000 *
                           (result.coordinate >= 0 ? row.string->moment_arm : row.string->path.length));
        }
        out << padded(one_line(model.muscles[m].name), width) << "  " << to_text(length);
        if (result.coordinate >= 0)
            out << "  " << to_text(arm);
        if (strings)
            out << "  " << to_text(string);
        out << '\n';
    }
    if (muscles > most_lines)
        out << "and " << muscles - most_lines << " more in lines.csv\n";
    for (const LinesRow& row : result.rows)
        buried += row.string && !row.string->path.clear ? 1U : 0U;
    if (buried > 0)
        out << "note: " << buried << " of " << result.rows.size()
            << " strings could not be led out of the bones; string_clear is 0 there\n";
}

} // namespace fascicle::app
