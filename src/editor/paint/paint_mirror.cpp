#include "editor/paint/paint_mirror.hpp"

#include "fascicle/geometry/bounding_box.hpp"

namespace fascicle::editor {

namespace {

/// Bones of the two sides are no exact images of each other.
constexpr double reach_mm = 15;

Vec3 middle(const Bone& bone) {
    const BoundingBox box = bounding_box(bone.mesh->positions, bone.mesh->triangles);
    return 0.5 * (box.min + box.max);
}

} // namespace

std::string other_side(const std::string& name) {
    if (name.size() < 3 || name[name.size() - 2] != '_')
        return {};
    static constexpr std::pair<char, char> sides[] = {{'l', 'r'}, {'r', 'l'}, {'L', 'R'}, {'R', 'L'}};
    for (const auto& [from, to] : sides)
        if (name.back() == from)
            return name.substr(0, name.size() - 1) + to;
    return {};
}

PaintMirror find_mirror(const Scene& scene, const actions::AreaKey& key, view::WorldAxes axes) {
    PaintMirror result;
    const Bone& bone = scene.bones[static_cast<std::size_t>(key.bone)];
    actions::StrokeMirror mirror{key, {}, reach_mm / millimetres_per_unit(scene.unit)};
    const std::string pair = other_side(bone.name);
    if (!pair.empty()) {
        mirror.area.bone = scene.bone_index(pair);
        if (mirror.area.bone < 0) {
            result.reason = "the scene has no bone '" + pair + "'";
            return result;
        }
    }
    const std::string muscle_pair = other_side(scene.muscles[static_cast<std::size_t>(key.muscle)].name);
    if (const int m = muscle_pair.empty() ? -1 : scene.muscle_index(muscle_pair); m >= 0)
        mirror.area.muscle = m;
    mirror.plane.normal = view::anatomical_frame(axes).left;
    mirror.plane.point =
        0.5 * (middle(bone) + middle(scene.bones[static_cast<std::size_t>(mirror.area.bone)]));
    result.stroke = mirror;
    return result;
}

} // namespace fascicle::editor
