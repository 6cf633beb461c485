#pragma once
// The section plane as the editor keeps it: orientation, place, side.

#include "fascicle/geometry/bounding_box.hpp"
#include "view/camera.hpp"
#include "view/section_plane.hpp"

#include <optional>

namespace fascicle::editor {

struct EditorContext;

/// What the plane looks along: where the camera looked when it was chosen, or an anatomical axis.
enum class SectionAxis { view, sagittal, coronal, axial };
const char* to_text(SectionAxis axis); ///< "View", ...

struct Section {
    bool on = false;
    SectionAxis axis = SectionAxis::view;
    Vec3 normal = Vec3::UnitX(); ///< unit length; position grows along it
    double position = 0;         ///< scene units along the normal, from the origin
    bool flipped = false;        ///< false: what lies beyond the position along the normal is taken away
};

/// Orients the plane along the axis, through `through`, and takes the side away that faces the camera.
void orient(Section& section, SectionAxis axis, const view::Camera& camera, const Vec3& through);
/// Where a new cut goes: through the middle of the selection, else of the visible muscles, else through the camera's pivot.
Vec3 section_place(const EditorContext& context);
/// Positions at which the plane meets the box; (0, 0) for an empty one.
std::pair<double, double> section_range(const Section& section, const BoundingBox& box);
/// Moves it by a share of its range and keeps it there; positive: towards the side that is taken away.
void move_section(Section& section, const BoundingBox& box, double share);
/// What is drawn; nothing while it is off.
std::optional<view::SectionPlane> section_plane(const Section& section);

} // namespace fascicle::editor
