#pragma once
// What the editor's own work costs, without a window: `fascicle-editor --measure` prints it.

#include "editor/paint/measure_strokes.hpp"
#include "fascicle/base/job_control.hpp"

#include <optional>
#include <string>

namespace fascicle::editor {

/// Frames of one kind. CPU milliseconds of the interface's thread; `own` leaves out what the software rasteriser takes of it.
struct FrameCost {
    std::string what;
    std::vector<double> own_ms;
    std::vector<double> raster_ms;
};

struct EditorCost {
    int bone_triangles = 0, muscle_triangles = 0, fibres = 0, plots = 0;
    std::vector<FrameCost> frames;
    double idle_cpu_share = 0; ///< CPU time of the whole process over wall time while nothing happens
    std::optional<double>
        idle_redraw; ///< seconds to the next frame that is wanted then; none: the program sleeps
    int stroke_triangles = 0;
    StrokeTimes strokes;
};

/// Two bones of together 137,000 triangles and more, a muscle of 20,000 with 100 fibres, all plots that fit, in a window of
/// 1600 x 1000, drawn with OSMesa; and strokes on a bone of 250,000 triangles. Takes some ten seconds.
/// Error when OSMesa is missing.
EditorCost measure_editor(const JobControl& control = {});

/// A table for people, with the limits that the figures are held against.
std::string to_text(const EditorCost& cost);

} // namespace fascicle::editor
