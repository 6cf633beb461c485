#include "io/osim_export/report_files.hpp"

#include "fascicle/base/build_info.hpp"
#include "fascicle/io/csv.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

namespace fascicle::io {
namespace {

using Json = nlohmann::ordered_json;

struct QuantityRow {
    const char* key;
    const char* meaning;
    double OsimFibreReport::*value;
};

/// Columns of the table after those that name the fibre.
constexpr std::array<QuantityRow, 7> quantities{{
    {"length_difference_mm", "length, at the fitted frames", &OsimFibreReport::length_mm},
    {"length_difference_between_mm", "length, half-way between the fitted frames",
     &OsimFibreReport::length_between_mm},
    {"moment_arm_difference_mm", "moment arm by tendon excursion, of both by the method of fibres.csv",
     &OsimFibreReport::moment_arm_mm},
    {"exact_moment_arm_difference_mm",
     "exact -dL/dq of the model against fibres.csv, at the fitted frames and between",
     &OsimFibreReport::exact_moment_arm_mm},
    {"opensim_moment_arm_difference_mm",
     "moment arm as OpenSim's solver computes it against fibres.csv, at the fitted frames and between",
     &OsimFibreReport::opensim_moment_arm_mm},
    {"point_difference_mm", "distance of path points from the simulated ones, at the fitted frames",
     &OsimFibreReport::point_mm},
    {"length_difference_other_frames_mm",
     "length, at frames that the model was not fitted to (the way back of a hinge)",
     &OsimFibreReport::length_other_frames_mm},
}};

/// Two decimals, rounded up: a promise that holds.
std::string two_decimals(double value) {
    if (!std::isfinite(value))
        return "nan";
    char text[40];
    const double up = std::ceil(value * 100 - 1e-9) / 100;
    const auto end = std::to_chars(text, text + sizeof text, up, std::chars_format::fixed, 2).ptr;
    return {text, end};
}

Json number_json(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

std::string counted(std::size_t n, const char* what) {
    return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

} // namespace

std::string summary_line(const OsimExportReport& report) {
    std::size_t points = 0, moving = 0;
    int least = 0, most = 0;
    for (const OsimFibreReport& f : report.fibres) {
        points += static_cast<std::size_t>(f.points);
        moving += static_cast<std::size_t>(f.moving_points);
        if (f.knots > 0) {
            least = least == 0 ? f.knots : std::min(least, f.knots);
            most = std::max(most, f.knots);
        }
    }
    std::string line = counted(report.fibres.size(), "fibre") + ", " + counted(points, "path point") + " (" +
                       std::to_string(moving) + " moving";
    if (moving > 0)
        line += ", " + std::to_string(least) +
                (least == most ? std::string() : " to " + std::to_string(most)) + " knots";
    line += "): length within " +
            two_decimals(std::fmax(report.largest(&OsimFibreReport::length_mm),
                                   report.largest(&OsimFibreReport::length_between_mm))) +
            " mm";
    const double arm = report.largest(&OsimFibreReport::moment_arm_mm);
    if (std::isfinite(arm))
        line += ", moment arm within " + two_decimals(arm) + " mm";
    line += " of the simulated ones, at " + counted(static_cast<std::size_t>(report.fitted_frames), "frame") +
            " and between";
    if (std::isfinite(arm))
        line += " (arms by tendon excursion; the model's exact -dL/dq within " +
                two_decimals(report.largest(&OsimFibreReport::exact_moment_arm_mm)) +
                " mm, OpenSim's solver " +
                two_decimals(report.largest(&OsimFibreReport::opensim_moment_arm_mm)) + " mm)";
    if (const double back = report.largest(&OsimFibreReport::length_other_frames_mm); std::isfinite(back))
        line += "; in the " + counted(static_cast<std::size_t>(report.other_frames), "other frame") +
                " the length differs by up to " + two_decimals(back) + " mm";
    return line;
}

std::string report_table(const OsimExportReport& report) {
    std::ostringstream out;
    CsvWriter csv(out);
    for (const char* column : {"muscle", "fibre", "name", "points", "moving_points", "knots"})
        csv.text(column);
    for (const QuantityRow& row : quantities)
        csv.text(row.key);
    csv.end_row();
    for (const OsimFibreReport& f : report.fibres) {
        csv.text(f.muscle).integer(f.fibre).text(f.name);
        csv.integer(f.points).integer(f.moving_points).integer(f.knots);
        for (const QuantityRow& row : quantities)
            csv.number(f.*row.value);
        csv.end_row();
    }
    return out.str();
}

std::string report_facts(const OsimExportReport& report, const OsimExportOptions& options, const Scene& scene,
                         const BakedModel& model) {
    Json json;
    json["summary"] = report.summary;
    json["model"] = report.model.filename().string();
    json["motion"] = report.motion.filename().string();
    json["axes"] = options.axes == AxisMapping::as_is ? "as-is" : "opensim";
    json["coordinate"] = {{"name", report.coordinate},
                          {"range", {report.range_min, report.range_max}},
                          {"unit", model.coordinates.front().rotational ? "rad" : "progress from 0 to 1"}};
    json["tolerance_mm"] = options.tolerance_mm;
    json["fitted_frames"] = report.fitted_frames;
    json["other_frames"] = report.other_frames;
    json["bone_difference_mm"] = report.bone_mm;
    json["specific_tension_n_per_cm2"] = options.specific_tension;
    double force = 0;
    for (const BakedFibre& fibre : model.fibres)
        force += fibre.max_force_n;
    json["max_isometric_force_n"] = force;
    for (const QuantityRow& row : quantities)
        json["largest"][row.key] = number_json(report.largest(row.value));
    for (const QuantityRow& row : quantities)
        json["meaning"][row.key] = row.meaning;
    json["fibres"] = Json::array();
    for (const OsimFibreReport& f : report.fibres) {
        Json fibre{{"muscle", f.muscle},
                   {"fibre", f.fibre},
                   {"name", f.name},
                   {"points", f.points},
                   {"moving_points", f.moving_points},
                   {"knots", f.knots}};
        for (const QuantityRow& row : quantities)
            fibre[row.key] = number_json(f.*row.value);
        json["fibres"].push_back(std::move(fibre));
    }
    json["inputs"] = Json::array();
    const auto add = [&](const MeshSource& source) {
        if (!source.path.empty())
            json["inputs"].push_back({{"path", source.path}, {"hash", source.hash}});
    };
    for (const Muscle& m : scene.muscles) {
        add(m.source);
        for (const MeshSource& source : m.outline_files)
            add(source);
        add(m.surface_fibres_source);
        add(m.fibre_template_source);
    }
    for (const Bone& b : scene.bones)
        add(b.source);
    add(scene.motion_source);
    json["notes"] = report.notes;
    json["program"] = {{"name", "fascicle"}, {"version", program_version()}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace fascicle::io
