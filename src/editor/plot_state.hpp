#pragma once
// How the plots are looked at: which ones, which part of them. Never undone, never saved with the scene.

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>

namespace fascicle::editor {

/// Visible part of an axis.
struct PlotRange {
    double low = 0, high = 300;
    bool operator==(const PlotRange&) const = default;
};

/// A drag in a plot, from press to release.
struct PlotGesture {
    enum class Kind { none, scrub, pan, box };
    Kind kind = Kind::none;
    std::string plot;               ///< where it began
    float start_x = 0, start_y = 0; ///< pixels
    bool far = false;               ///< it moved: no click any more
    bool moves_y = false;           ///< of a pan: it went up or down enough to move the axis of y
};

struct PlotsState {
    std::optional<PlotRange> angles;    ///< degrees on the axis of x; nothing: all
    std::map<std::string, PlotRange> y; ///< per plot, where the user chose it; otherwise it fits
    std::set<std::string> hidden{"plot/penetrating_vertices", "plot/stage_time"};
    std::string maximised;  ///< the one plot shown, or all of them
    bool over_view = false; ///< the chosen ones lie over the view too
    std::array<std::string, 2> chosen{"plot/volume_ratio", ""};
    bool single_fibres = true; ///< a line for every fibre
    bool ghosts = true;        ///< curves of earlier runs
    bool extremes = false;     ///< the 99th percentile beside the band
    PlotGesture gesture;
};

} // namespace fascicle::editor
