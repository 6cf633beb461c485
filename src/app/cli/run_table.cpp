#include "app/cli/run_table.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/text.hpp"
#include "fascicle/io/run_writer.hpp"
#include "fascicle/metrics/metric_table.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <ostream>

namespace fascicle::app {

namespace {

std::size_t column(const std::string& key) {
    const auto& rows = metric_table();
    const auto it =
        std::find_if(rows.begin(), rows.end(), [&](const MetricRow& row) { return row.key == key; });
    FASCICLE_ASSERT(it != rows.end());
    return static_cast<std::size_t>(it - rows.begin());
}

double rms_distance(const Points& a, const Points& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += (a[i] - b[i]).squaredNorm();
    return a.empty() ? 0.0 : std::sqrt(sum / double(a.size()));
}

} // namespace

RunTable::RunTable(const Scene& scene)
    : scene_(scene), volume_column_(column("volume_ratio")),
      penetrating_column_(column("penetrating_vertices")), rows_(scene.muscles.size()) {}

void RunTable::add(const Frame&, const std::vector<std::vector<double>>& metrics) {
    for (std::size_t m = 0; m < rows_.size(); ++m) {
        rows_[m].volume_error = std::max(rows_[m].volume_error, std::abs(metrics[m][volume_column_] - 1));
        rows_[m].penetrating = std::max(rows_[m].penetrating, metrics[m][penetrating_column_]);
    }
}

void RunTable::print(std::ostream& out, const Recording& recording) const {
    const FramePtr rest = recording.frame(0), last = recording.last_frame();
    std::size_t width = std::string("muscle").size();
    for (const Muscle& muscle : scene_.muscles)
        width = std::max(width, muscle.name.size());
    const auto name = [&](const std::string& text) {
        return one_line(text) + std::string(width - text.size(), ' ');
    };
    out << name("muscle") << "  volume error max  end rms from rest  penetrating max\n" << std::fixed;
    for (std::size_t m = 0; m < rows_.size(); ++m) {
        const double rms = rms_distance(*rest->muscle_positions[m], *last->muscle_positions[m]);
        out << name(scene_.muscles[m].name) << std::setprecision(4) << std::setw(16)
            << 100 * rows_[m].volume_error << " %" << std::setw(16) << rms * millimetres_per_unit(scene_.unit)
            << " mm" << std::setprecision(0) << std::setw(17) << rows_[m].penetrating << '\n';
    }
    const RunSpeed speed = run_speed(recording);
    out << std::setprecision(1) << recording.frame_count() - 1 << " frames at " << speed.fps_median
        << " frames/s (median; mean " << speed.fps_mean << "), prepared in " << recording.prepare_seconds()
        << " s, solved in " << speed.solve_seconds << " s\n";
}

} // namespace fascicle::app
