#pragma once
// The other side of the body: pairs by suffix _l and _r.

#include "fascicle/document/actions/area_actions.hpp"
#include "view/camera.hpp"

namespace fascicle::editor {

/// "femur_r" for "femur_l" and the other way round, also with capitals; empty for a name without a side.
std::string other_side(const std::string& name);

/// stroke: nothing when there is no other side to paint on, then `reason` says why.
struct PaintMirror {
    std::optional<actions::StrokeMirror> stroke;
    std::string reason;
};
/// A bone with a side is mirrored to its pair, one without to itself; the muscle likewise, where it has a pair. The plane is the
/// sagittal one half way between the pair's boxes, or through the middle of the bone's own box.
PaintMirror find_mirror(const Scene& scene, const actions::AreaKey& key, view::WorldAxes axes);

} // namespace fascicle::editor
