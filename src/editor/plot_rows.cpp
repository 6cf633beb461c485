#include "editor/plot_rows.hpp"

namespace fascicle::editor {

const std::vector<PlotRow>& plot_rows() {
    static const char* const edges = "Band: 10th to 90th percentile of the edges.";
    static const char* const dihedrals = "Band: 10th to 90th percentile of the dihedrals.";
    static const char* const fibres = "Band: 5th to 95th percentile of the fibres. Thin: single fibres.";
    static const std::vector<PlotRow> rows{
        {"plot/volume_ratio", "volume_ratio", "Volume ratio", nullptr, nullptr, nullptr, "", 1.0, 0.002},
        {"plot/edge_extension", "edge_extension_mean", "Mean edge extension", "edge_extension_p10",
         "edge_extension_p90", "edge_extension_p99", edges, 1.0, 0.01},
        {"plot/dihedral_change", "dihedral_change_mean_rad", "Mean dihedral change",
         "dihedral_change_p10_rad", "dihedral_change_p90_rad", nullptr, dihedrals, std::nullopt, 0.01},
        {"plot/fibre_length", "fibre_length_mean_mm", "Fibre length", "fibre_length_p5_mm",
         "fibre_length_p95_mm", nullptr, fibres, std::nullopt, 1.0, &FibreValues::lengths_mm,
         &LineSeries::lengths_mm},
        {"plot/moment_arm", "moment_arm_mean_mm", "Moment arm", "moment_arm_p5_mm", "moment_arm_p95_mm",
         nullptr, fibres, 0.0, 1.0, &FibreValues::moment_arms_mm, &LineSeries::moment_arms_mm},
        {"plot/penetration", "penetration_max_mm", "Penetration depth", nullptr, nullptr, nullptr, "", 0.0,
         0.1},
        {"plot/penetrating_vertices", "penetrating_vertices", "Penetrating vertices", nullptr, nullptr,
         nullptr, "", 0.0, 1.0},
        {"plot/stage_time", "solve_ms", "Time per stage", nullptr, nullptr, nullptr,
         "Areas: what each stage of the solver takes of a frame, one on the other.", 0.0, 0.1, nullptr,
         nullptr, true},
    };
    return rows;
}

const PlotRow* find_plot_row(std::string_view id) {
    for (const PlotRow& row : plot_rows())
        if (id == row.id)
            return &row;
    return nullptr;
}

const MetricRow& metric_of(const PlotRow& row) {
    return metric_table().at(static_cast<std::size_t>(metric_index(row.key)));
}

} // namespace fascicle::editor
