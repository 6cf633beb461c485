#pragma once
// What a frame of a stroke costs, without a window: for `fascicle-editor --measure` and for whoever changes the tools.

#include "fascicle/geometry/tri_mesh.hpp"

#include <vector>

namespace fascicle::editor {

struct StrokeTimes {
    double prepare_ms = 0;        ///< neighbours and tree of the bone, once
    std::vector<double> frame_ms; ///< of each frame: pick, step, cursor, colours and border, numbers
    std::vector<double> hover_ms; ///< the same for a pointer that only hovers: pick, preview, cursor, colours
    std::size_t most_colours = 0; ///< colours that one frame sends to the GPU at most
    int painted = 0;              ///< vertices in the end
    double median_ms() const;     ///< of frame_ms
    double worst_ms() const;
    double worst_hover_ms() const;
};

/// Draws a stroke of `frames` steps with a connected brush over the side of the bone that faces +x, 2 % of the bone's size a
/// frame, back and forth. radius: scene units.
StrokeTimes measure_strokes(const MeshPtr& bone, double radius, int frames);

} // namespace fascicle::editor
