#pragma once
// Frames of the timeline in the unit that ruler and plots show.

#include "editor/editor_context.hpp"

namespace fascicle::editor {

/// Seconds of one frame: solver.frame_time.
double frame_seconds(const Scene& scene);
/// A frame as the axis shows it: "60", "1.00", "-34".
std::string frame_text(const Scene& scene, RulerUnit unit, double frame);
/// "frame", "time [s]", "angle [deg]".
const char* axis_label(RulerUnit unit);

} // namespace fascicle::editor
