#include "embedded.hpp"

#include "fascicle/geometry/primitives.hpp"
#include "fascicle/scene/embedded_scenes.hpp"

#include <cmath>

namespace fascicle {

namespace {
const double half_pi = 1.57079632679489661923;
using C = CylinderScene;
} // namespace

double cylinder_moment_arm(double offset) {
    return C::cylinder_radius + C::clearance + 0.5 * C::thickness + offset;
}

double cylinder_path_length(double angle_rad, double offset) {
    return 2.0 * C::straight_length + cylinder_moment_arm(offset) * (half_pi + angle_rad);
}

namespace embedded {

namespace {

/// Point of the strap at arc length s of its middle surface, `out` away from it (positive away from the cylinder) and
/// x across. The wrap runs from the front (y = -r) to the underside (z = -r).
Vec3 strap_point(double s, double out, double x) {
    const double middle = cylinder_moment_arm(), wrap = middle * half_pi;
    const double r = middle + out;
    if (s <= C::straight_length)
        return {x, -r, C::straight_length - s};
    if (s >= C::straight_length + wrap)
        return {x, s - C::straight_length - wrap, -r};
    const double angle = (s - C::straight_length) / middle; // 0 in front, a quarter turn below
    return {x, -r * std::cos(angle), -r * std::sin(angle)};
}

Bone make_bone(const char* name, TriMesh mesh) {
    Bone bone;
    bone.name = name;
    bone.mesh = std::make_shared<TriMesh>(std::move(mesh));
    return bone;
}

Muscle make_strap(int fixed_bone, int moving_bone) {
    const double length = cylinder_path_length(0.0);
    // A box in (arc length, across, out), bent round the cylinder; the three directions are right-handed in this order.
    TriMesh mesh = box_mesh(Vec3(0, -0.5 * C::width, -0.5 * C::thickness),
                            Vec3(length, 0.5 * C::width, 0.5 * C::thickness), {72, 11, 2});
    Attachment origin{AttachmentKind::origin, fixed_bone, {}};
    Attachment insertion{AttachmentKind::insertion, moving_bone, {}};
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        Vec3& p = mesh.positions[static_cast<std::size_t>(v)];
        if (p.x() <= C::attached_length)
            origin.vertices.push_back(v);
        if (p.x() >= length - C::attached_length)
            insertion.vertices.push_back(v);
        p = strap_point(p.x(), p.z(), p.y());
    }
    Muscle strap;
    strap.name = "strap";
    strap.mesh = std::make_shared<TriMesh>(std::move(mesh));
    strap.attachments = {origin, insertion};
    strap.attach_automatically = false;
    return strap;
}

} // namespace

Scene make_cylinder(int) {
    Scene scene;
    const double r = C::cylinder_radius;
    const double near = C::straight_length - 16, far = C::straight_length + 10; // of the blocks
    scene.bones.push_back(make_bone("cylinder", cylinder_mesh(Vec3(-20, 0, 0), Vec3(20, 0, 0), r, 120, 20)));
    scene.bones.push_back(
        make_bone("fixed_block", box_mesh(Vec3(-16, -r, near), Vec3(16, -0.4 * r, far), {16, 6, 13})));
    scene.bones.push_back(
        make_bone("moving_block", box_mesh(Vec3(-16, near, -r), Vec3(16, far, -0.4 * r), {16, 13, 6})));
    scene.muscles.push_back(make_strap(1, 2));
    scene.timeline =
        make_hinge_timeline({Vec3::Zero(), Vec3::UnitX()}, C::angle_rad, {100, 100, 100}, 3, {2});
    // Nearly passive: fibres give way, so that tension hardly presses the far side of the strap towards the cylinder
    // (a surface that encloses volume resists that by its bending only), yet the side that lies on it stays taut.
    bring_defaults(scene.parameters, {{"solver.stiffness", 0.3},
                                      {"solver.bending", 0.9},
                                      {"solver.coarse", 0}}); // so soft, it has no waves that lag
    return scene;
}

} // namespace embedded

} // namespace fascicle
