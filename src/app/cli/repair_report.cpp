#include "app/cli/repair_report.hpp"

#include "fascicle/base/text.hpp"

#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <ostream>

namespace fascicle::app {

namespace {

using Json = nlohmann::ordered_json;

std::string text(double value) {
    char buffer[40];
    std::snprintf(buffer, sizeof buffer, "%.6g", value);
    return buffer;
}

std::string volume_text(const SurfaceMeasures& measures) {
    return measures.closed ? text(measures.volume) : "none";
}

std::string change_text(double before, double after) {
    const double percent = before != 0 ? 100 * (after / before - 1) : 0.0;
    constexpr double rounding = 1e-9;
    if (std::abs(percent) < rounding)
        return "0 %";
    char buffer[40];
    std::snprintf(buffer, sizeof buffer, "%+.3g %%", percent);
    return buffer;
}

Json measures_json(const SurfaceMeasures& m, const MeshReport& r) {
    return {{"vertices", m.vertices},
            {"triangles", m.triangles},
            {"area", m.area},
            {"volume", m.closed ? Json(m.volume) : Json(nullptr)},
            {"closed", m.closed},
            {"parts", r.components},
            {"boundary_edges", r.boundary_edges},
            {"holes", r.holes},
            {"nonmanifold_edges", r.nonmanifold_edges},
            {"nonmanifold_vertices", r.nonmanifold_vertices},
            {"duplicate_vertices", r.duplicate_vertices},
            {"zero_area_triangles", r.zero_area_triangles},
            {"cavities", r.cavities}};
}

/// null for what is without a limit: JSON has no infinity.
Json finite(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

} // namespace

void print(std::ostream& out, const RepairReport& report, const RepairResult& result) {
    out << one_line(report.in) << '\n';
    for (const std::string& note : report.notes)
        out << "  note     " << one_line(note) << '\n';
    if (result.steps.empty())
        out << "  found    nothing to repair\n";
    for (const RepairStep& step : result.steps)
        out << (step.done > 0 ? "  done     " : "  left     ") << step.text << '\n';
    for (const std::string& line : result.left)
        out << "  left     " << line << '\n';
    const SurfaceMeasures &a = result.measured_before, &b = result.measured_after;
    const std::string unit = report.unit;
    const auto row = [&](const std::string& name, const std::string& before, const std::string& after,
                         const std::string& change) {
        out << "  " << std::left << std::setw(14) << name << std::right << std::setw(14) << before
            << std::setw(14) << after << std::setw(12) << change << '\n';
    };
    row(report.unit_guessed ? "(" + unit + " guessed)" : "", "before", "after", "change");
    row("vertices", std::to_string(a.vertices), std::to_string(b.vertices),
        change_text(a.vertices, b.vertices));
    row("triangles", std::to_string(a.triangles), std::to_string(b.triangles),
        change_text(a.triangles, b.triangles));
    row("area " + unit + "2", text(a.area), text(b.area), change_text(a.area, b.area));
    row("volume " + unit + "3", volume_text(a), volume_text(b),
        a.closed && b.closed ? change_text(a.volume, b.volume) : "");
    if (!result.good())
        return;
    if (report.arrays > 0)
        out << "  " << report.arrays << (report.arrays == 1 ? " array" : " arrays")
            << " per point carried over\n";
    out << "closed, manifold, consistently oriented; written to " << one_line(report.out) << '\n';
}

std::string to_json(const RepairReport& report, const RepairResult& result) {
    Json json;
    json["input"] = report.in;
    json["output"] = result.good() ? Json(report.out) : Json(nullptr);
    json["good"] = result.good();
    json["reason"] = result.reason;
    json["unit"] = report.unit;
    json["unit_guessed"] = report.unit_guessed;
    const RepairOptions& o = report.options;
    json["options"] = {{"weld", o.weld < 0 ? Json(nullptr) : Json(o.weld)},
                       {"fill_edges", o.fill_edges},
                       {"fill_share", finite(o.fill_share)},
                       {"island_share", o.island_share},
                       {"smooth_passes", o.smooth_passes},
                       {"edge_length", o.edge_length},
                       {"triangles", o.triangles},
                       {"volume_share", o.volume_share},
                       {"untangle", o.untangle}};
    json["before"] = measures_json(result.measured_before, result.before);
    json["after"] = measures_json(result.measured_after, result.after);
    json["steps"] = Json::array();
    for (const RepairStep& step : result.steps)
        json["steps"].push_back(
            {{"key", step.key}, {"found", step.found}, {"done", step.done}, {"text", step.text}});
    json["crossing_pairs"] = result.crossings;
    json["first_crossing_pairs"] = Json::array();
    for (std::size_t i = 0; i < std::min<std::size_t>(10, result.first_crossings.size()); ++i)
        json["first_crossing_pairs"].push_back(result.first_crossings[i]);
    json["left"] = result.left;
    json["notes"] = report.notes;
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace fascicle::app
