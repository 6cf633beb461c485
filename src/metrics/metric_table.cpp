#include "fascicle/metrics/metric_table.hpp"

#include "fascicle/metrics/muscle_measure.hpp"

#include <limits>

namespace fascicle {

namespace {

using M = const MuscleMeasure&;

std::vector<MetricRow> make_rows() {
    std::vector<MetricRow> rows;
    const auto add = [&](std::string key, std::string label, std::string unit, std::string meaning,
                         std::function<double(M)> value) {
        rows.push_back({std::move(key), std::move(label), std::move(unit), std::move(meaning),
                        std::move(value), false, nullptr});
    };
    // The contract's columns, in its order.
    add("volume_ratio", "Volume ratio", "1", "Volume against rest.", [](M m) { return m.volume_ratio(); });
    add("edge_extension_mean", "Edge extension, mean", "1",
        "Mean of length against rest length over the unique edges.", [](M m) { return m.edges().mean; });
    add("edge_extension_p99", "Edge extension, 99th percentile", "1",
        "One edge in a hundred is stretched more than this.", [](M m) { return m.edges().p99; });
    add("dihedral_change_mean_rad", "Dihedral change, mean", "rad",
        "Mean absolute change of the signed dihedral angle since rest.",
        [](M m) { return m.dihedrals().mean_rad; });
    add("penetrating_vertices", "Penetrating vertices", "1",
        "Vertices deeper than 0.1 mm inside a bone that they were not inside of at rest.",
        [](M m) { return static_cast<double>(m.penetration().count); });
    add("penetration_max_mm", "Penetration, greatest depth", "mm",
        "Depth of the deepest vertex inside a bone that it was not inside of at rest.",
        [](M m) { return m.penetration().max_mm; });
    // What else there is.
    const auto edges = [&](const char* name, double EdgeExtension::*field) {
        add(std::string("edge_extension_") + name, std::string("Edge extension, ") + name, "1",
            "Order statistic of length against rest length over the unique edges (p50: the median).",
            [field](M m) { return m.edges().*field; });
    };
    edges("p1", &EdgeExtension::p1);
    edges("p10", &EdgeExtension::p10);
    edges("p25", &EdgeExtension::p25);
    edges("p50", &EdgeExtension::p50);
    edges("p75", &EdgeExtension::p75);
    edges("p90", &EdgeExtension::p90);
    edges("max", &EdgeExtension::max);
    const auto dihedrals = [&](const char* name, double DihedralChange::*field) {
        add(std::string("dihedral_change_") + name + "_rad", std::string("Dihedral change, ") + name, "rad",
            "Percentile of the absolute change of the signed dihedral angle since rest.",
            [field](M m) { return m.dihedrals().*field; });
    };
    dihedrals("p10", &DihedralChange::p10_rad);
    dihedrals("p25", &DihedralChange::p25_rad);
    dihedrals("p50", &DihedralChange::p50_rad);
    dihedrals("p75", &DihedralChange::p75_rad);
    dihedrals("p90", &DihedralChange::p90_rad);
    add("dihedral_change_unsigned_mean_deg", "Dihedral change, unsigned mean", "deg",
        "Mean absolute change of the unsigned (acos) dihedral angle since rest, as the paper plots it.",
        [](M m) { return m.dihedrals().unsigned_mean_deg; });
    add("dihedral_above_90_share", "Dihedrals above 90 degrees", "1",
        "Share of dihedrals bent by more than 90 degrees from flat, either way.",
        [](M m) { return m.dihedrals().share_above_90_deg; });
    add("hausdorff_to_rest_mm", "Hausdorff distance to rest", "mm",
        "Largest distance of a vertex of the surface now or at rest to the other surface.",
        [](M m) { return m.millimetres_per_unit() * m.rest_distance().hausdorff; });
    add("displacement_mean_mm", "Displacement from rest, mean", "mm",
        "Mean distance of a vertex from its own place at rest.",
        [](M m) { return m.millimetres_per_unit() * m.rest_distance().mean; });
    add("displacement_rms_mm", "Displacement from rest, rms", "mm",
        "Root mean square distance of a vertex from its own place at rest.",
        [](M m) { return m.millimetres_per_unit() * m.rest_distance().rms; });
    add("displacement_max_mm", "Displacement from rest, largest", "mm",
        "Largest distance of a vertex from its own place at rest.",
        [](M m) { return m.millimetres_per_unit() * m.rest_distance().max; });
    add("attachment_drift_mm", "Attachment drift", "mm",
        "Largest distance of an attached vertex from where its bone carries it; must be 0.",
        [](M m) { return m.attachment_drift_mm(); });
    add("volume_cm3", "Volume", "cm3", "Volume that the surface encloses.",
        [](M m) { return m.volume_cm3(); });
    add("area_cm2", "Surface area", "cm2", "Area of the surface.", [](M m) { return m.area_cm2(); });
    // Of the fibres.
    const double none = std::numeric_limits<double>::quiet_NaN();
    const auto fibres = [&](std::string key, std::string label, std::string unit, std::string meaning,
                            std::function<double(const FibreMeasure&)> value) {
        add(std::move(key), std::move(label), std::move(unit), std::move(meaning),
            [value = std::move(value), none](M m) { return m.fibres() ? value(*m.fibres()) : none; });
        rows.back().of_fibres = true;
    };
    using B = double Band::*;
    const std::pair<const char*, B> parts[] = {
        {"mean", &Band::mean}, {"min", &Band::min}, {"p5", &Band::p5},   {"p25", &Band::p25},
        {"p50", &Band::p50},   {"p75", &Band::p75}, {"p95", &Band::p95}, {"max", &Band::max}};
    for (const auto& [name, part] : parts)
        fibres(std::string("fibre_length_") + name + "_mm", std::string("Fibre length, ") + name, "mm",
               "Length of the fibres, from origin to insertion.",
               [part = part](const FibreMeasure& f) { return f.length_mm().*part; });
    for (const auto& [name, part] : parts)
        fibres(std::string("fibre_strain_") + name, std::string("Fibre strain, ") + name, "1",
               "Change of length against rest length over the fibres.",
               [part = part](const FibreMeasure& f) { return f.strain().*part; });
    for (const auto& [name, part] : parts) {
        fibres(std::string("moment_arm_") + name + "_mm", std::string("Moment arm, ") + name, "mm",
               "Moment arm of the fibres by tendon excursion, positive for what shortens on the way out.",
               [none](const FibreMeasure&) { return none; });
        rows.back().over_run = [part = part](const FibreSeries& series, int k) {
            return series.band(FibreQuantity::moment_arm, k).*part;
        };
    }
    fibres("pennation_mean_deg", "Pennation, mean", "deg",
           "Mean angle between the fibres' ends and the line of action there.",
           [](const FibreMeasure& f) { return f.pennation_deg(); });
    fibres("pcsa_cm2", "Physiological cross-section", "cm2",
           "Volume times cos(pennation) over mean fibre length.",
           [](const FibreMeasure& f) { return f.pcsa_cm2(); });
    fibres("line_length_mm", "Line of action, length", "mm",
           "Distance between the middle of the origins and that of the insertions.",
           [](const FibreMeasure& f) { return f.line_length_mm(); });
    // Of the whole frame, the same for all its muscles.
    add("contacts", "Contacts", "1", "Contact projections of the frame that moved a vertex, all muscles.",
        [](M m) { return static_cast<double>(m.report().contacts); });
    add("unresolved", "Unresolved contacts", "1",
        "Vertices that contact could not put outside a bone in the frame, all muscles.",
        [](M m) { return static_cast<double>(m.report().unresolved); });
    add("non_finite", "Refused positions", "1",
        "Positions that were not finite and were refused, all muscles.",
        [](M m) { return static_cast<double>(m.report().non_finite); });
    add("solve_ms", "Solving time", "ms", "Time of solving the frame, all muscles.",
        [](M m) { return 1000.0 * m.report().solve_seconds; });
    // After all earlier columns, so that these keep their places.
    add("penetrating_centroids", "Penetrating triangles", "1",
        "Triangles whose centroid is deeper than 0.1 mm inside a bone that it was not inside of at rest.",
        [](M m) { return static_cast<double>(m.centroid_penetration().count); });
    add("centroid_penetration_max_mm", "Penetration of triangles, greatest depth", "mm",
        "Depth of the deepest centroid of a triangle inside a bone that it was not inside of at rest.",
        [](M m) { return m.centroid_penetration().max_mm; });
    add("penetrating_midpoints", "Penetrating edges", "1",
        "Edges whose middle is deeper than 0.1 mm inside a bone that it was not inside of at rest.",
        [](M m) { return static_cast<double>(m.midpoint_penetration().count); });
    add("midpoint_penetration_max_mm", "Penetration of edges, greatest depth", "mm",
        "Depth of the deepest middle of an edge inside a bone that it was not inside of at rest.",
        [](M m) { return m.midpoint_penetration().max_mm; });
    add("muscle_overlap_mm", "Overlap with other muscles", "mm",
        "Largest depth of a vertex inside another muscle beyond its depth there at rest.",
        [](M m) { return m.overlap_mm(); });
    add("unconverged", "Passes without equilibrium", "1",
        "Passes of the frame that a method which seeks equilibrium ended without it, all muscles.",
        [](M m) { return static_cast<double>(m.report().unconverged); });
    return rows;
}

} // namespace

const std::vector<MetricRow>& metric_table() {
    static const std::vector<MetricRow> rows = make_rows();
    return rows;
}

int metric_index(std::string_view key) {
    const std::vector<MetricRow>& rows = metric_table();
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (rows[i].key == key)
            return static_cast<int>(i);
    return -1;
}

} // namespace fascicle
