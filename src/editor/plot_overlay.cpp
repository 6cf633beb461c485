#include "editor/plot_overlay.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/io/csv.hpp"
#include "fascicle/io/files.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace fascicle::editor {

namespace {

constexpr std::size_t most_bytes = std::size_t{64} << 20;
constexpr std::size_t most_curves = 64, most_rows = 100000;
constexpr double none = std::numeric_limits<double>::quiet_NaN();

bool ends_with(const std::string& text, const char* end) {
    const std::string_view tail = end;
    return text.size() >= tail.size() && std::string_view(text).substr(text.size() - tail.size()) == tail;
}

/// Axis and factor to its unit; false when the name says nothing.
bool axis_of(const std::string& column, PlotOverlay::Axis& axis, double& factor) {
    const std::string name = plain_column(column);
    const auto has = [&](const char* part) { return name.find(part) != std::string::npos; };
    factor = 1;
    if (has("frame")) {
        axis = PlotOverlay::Axis::frame;
    } else if (has("time") || name == "t" || name == "t_s" || name == "t_ms") {
        axis = PlotOverlay::Axis::seconds;
        factor = ends_with(name, "_ms") ? 0.001 : 1;
    } else if (has("angle") || has("flexion") || ends_with(name, "_deg") || ends_with(name, "_rad")) {
        axis = PlotOverlay::Axis::degrees;
        factor = ends_with(name, "_rad") ? 180 / std::numbers::pi : 1;
    } else {
        return false;
    }
    return true;
}

} // namespace

PlotOverlay read_overlay(const std::filesystem::path& file, const std::string& plot) {
    const std::string bytes = read_file(file, most_bytes);
    CsvReader csv(bytes, file.string());
    PlotOverlay overlay;
    overlay.name = file.filename().string();
    overlay.plot = plot;
    double factor = 1;
    if (!axis_of(csv.columns()[0], overlay.axis, factor))
        throw_error(file.string(), "first column '" + csv.columns()[0] + "' is no axis",
                    "a column named frame, time_s or angle_deg");
    if (csv.columns().size() < 2 || csv.columns().size() - 1 > most_curves)
        throw_error(file.string(), std::to_string(csv.columns().size()) + " columns",
                    "2 to " + std::to_string(most_curves + 1));
    for (std::size_t c = 1; c < csv.columns().size(); ++c)
        overlay.curves.push_back({csv.columns()[c], {}, {}});
    std::size_t rows = 0;
    while (csv.next_row()) {
        if (++rows > most_rows)
            throw_error(file.string(), "too many rows", "at most " + std::to_string(most_rows));
        const double x = csv.number(0) * factor;
        for (std::size_t c = 0; c < overlay.curves.size(); ++c) {
            const int column = static_cast<int>(c) + 1;
            const std::string& cell = csv.cell(column);
            if (cell.empty())
                continue; // this column has nothing here; its neighbours are joined
            overlay.curves[c].x.push_back(x);
            overlay.curves[c].y.push_back(cell == "nan" || cell == "NaN" ? none : csv.number(column));
        }
    }
    std::erase_if(overlay.curves, [](const OverlayCurve& curve) {
        return std::none_of(curve.y.begin(), curve.y.end(), [](double v) { return std::isfinite(v); });
    });
    if (overlay.curves.empty())
        throw_error(file.string(), "no values", "a number in at least one row and column");
    return overlay;
}

void place_overlay(PlotOverlay& overlay, double frame_seconds, const Timeline& timeline,
                   const std::vector<double>& planned_degrees) {
    for (OverlayCurve& curve : overlay.curves) {
        curve.frames = overlay_frames(overlay.axis, curve.x, frame_seconds, planned_degrees);
        curve.degrees = overlay_degrees(overlay.axis, curve.x, frame_seconds, timeline);
    }
}

std::vector<double> overlay_frames(PlotOverlay::Axis axis, std::span<const double> x, double frame_seconds,
                                   const std::vector<double>& planned_degrees) {
    std::vector<double> frames(x.begin(), x.end());
    if (axis == PlotOverlay::Axis::frame)
        return frames;
    for (double& value : frames) {
        if (axis == PlotOverlay::Axis::seconds) {
            value /= frame_seconds;
            continue;
        }
        double found = none;
        for (std::size_t k = 0; k < planned_degrees.size() && std::isnan(found); ++k) {
            const double a = planned_degrees[k];
            if (std::abs(a - value) < 1e-9)
                found = double(k);
            else if (k + 1 < planned_degrees.size() && (a - value) * (planned_degrees[k + 1] - value) < 0)
                found = double(k) + (value - a) / (planned_degrees[k + 1] - a);
        }
        value = found;
    }
    return frames;
}

std::vector<double> overlay_degrees(PlotOverlay::Axis axis, std::span<const double> x, double frame_seconds,
                                    const Timeline& timeline) {
    std::vector<double> degrees(x.begin(), x.end());
    if (axis != PlotOverlay::Axis::degrees)
        for (double& value : degrees) {
            const double frame = axis == PlotOverlay::Axis::seconds ? value / frame_seconds : value;
            value = frame < 0 || frame > timeline.last_frame
                        ? none
                        : timeline.angle_rad(frame) * 180 / std::numbers::pi;
        }
    return degrees;
}

} // namespace fascicle::editor
