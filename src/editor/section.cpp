#include "editor/section.hpp"

#include "editor/commands.hpp"

#include <algorithm>

namespace fascicle::editor {

const char* to_text(SectionAxis axis) {
    switch (axis) {
    case SectionAxis::view:
        return "View";
    case SectionAxis::sagittal:
        return "Sagittal";
    case SectionAxis::coronal:
        return "Coronal";
    case SectionAxis::axial:
        break;
    }
    return "Axial";
}

void orient(Section& section, SectionAxis axis, const view::Camera& camera, const Vec3& through) {
    const view::AnatomicalFrame frame = view::anatomical_frame(camera.axes());
    section.axis = axis;
    section.normal = axis == SectionAxis::view       ? camera.backward()
                     : axis == SectionAxis::sagittal ? frame.left
                     : axis == SectionAxis::coronal  ? frame.anterior
                                                     : frame.superior;
    section.position = section.normal.dot(through);
    section.flipped = section.normal.dot(camera.backward()) < 0;
}

Vec3 section_place(const EditorContext& context) {
    BoundingBox box = object_bounds(context, context.state.selection);
    if (box.empty())
        for (const Muscle& muscle : context.shown_scene().muscles)
            if (context.state.visible(muscle.name))
                box.add(object_bounds(context, {Selection::Kind::muscle, muscle.name}));
    return box.empty() ? context.state.camera.pivot() : Vec3(0.5 * (box.min + box.max));
}

std::pair<double, double> section_range(const Section& section, const BoundingBox& box) {
    if (box.empty())
        return {0, 0};
    const double middle = section.normal.dot(0.5 * (box.min + box.max));
    const double half = 0.5 * section.normal.cwiseAbs().dot(box.max - box.min);
    return {middle - half, middle + half};
}

void move_section(Section& section, const BoundingBox& box, double share) {
    const auto [low, high] = section_range(section, box);
    const double step = share * (high - low) * (section.flipped ? -1 : 1);
    section.position = std::clamp(section.position + step, low, high);
}

std::optional<view::SectionPlane> section_plane(const Section& section) {
    if (!section.on)
        return std::nullopt;
    const double sign = section.flipped ? -1 : 1;
    return view::SectionPlane{sign * section.normal, sign * section.position};
}

} // namespace fascicle::editor
