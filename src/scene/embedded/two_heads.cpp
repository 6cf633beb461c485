#include "embedded.hpp"

#include "fascicle/geometry/implicit_tube.hpp"
#include "fascicle/geometry/iso_surface.hpp"

#include <cmath>

namespace fascicle::embedded {

namespace {

constexpr double clearance = 0.5; ///< between muscle and bone where they touch
constexpr double lever_radius = 9.0;
const Vec3 hinge_centre(0, 28, -95);

/// One head from its block down to the lever; side: -1 left, 1 right. The right head is the shorter one.
std::vector<TubeStation> head_stations(double side) {
    const double top = side < 0 ? 104 : 88;
    return {{Vec3(27 * side, -6, top), 9, 6},        {Vec3(25 * side, -8, top - 22), 12, 8.5},
            {Vec3(20 * side, -10, 50), 13, 10.5},    {Vec3(12 * side, -11, 22), 12.5, 11.5},
            {Vec3(9 * side, -11, -10), 12, 12},      {Vec3(6 * side, -10, -45), 10, 10.5},
            {Vec3(2.5 * side, -8.5, -72), 7.5, 7.5}, {Vec3(1.5 * side, -8, -88.5), 7, 5.5}};
}

/// Width and middle of a head at a height, linear between its stations (z falls from one to the next).
struct HeadSlice {
    double x, wide;
};
HeadSlice slice_of(const std::vector<TubeStation>& stations, double z) {
    for (std::size_t i = 1; i < stations.size(); ++i)
        if (const TubeStation& a = stations[i - 1], &b = stations[i]; z >= b.point.z()) {
            const double t = std::min(1.0, (a.point.z() - z) / (a.point.z() - b.point.z()));
            return {a.point.x() + t * (b.point.x() - a.point.x()), a.wide + t * (b.wide - a.wide)};
        }
    return {stations.back().point.x(), stations.back().wide};
}

/// Three fibres on the front of each head, from its block to the lever.
std::shared_ptr<const Polylines> surface_fibres(const Implicit& muscle) {
    auto fibres = std::make_shared<Polylines>();
    for (const double side : {-1.0, 1.0})
        for (const double lane : {-0.55, 0.0, 0.55}) {
            const auto stations = head_stations(side);
            const double top = stations.front().point.z() - 7, bottom = -82;
            std::vector<int> line;
            for (int k = 0; k <= 12; ++k) {
                const double z = top + (bottom - top) * k / 12;
                const HeadSlice at = slice_of(stations, z);
                double outside = -40, inside = -7; // y: in front of the muscle, in its middle
                for (int step = 0; step < 40; ++step) {
                    const double y = 0.5 * (outside + inside);
                    (muscle(Vec3(at.x + lane * at.wide, y, z)) < 0.0 ? inside : outside) = y;
                }
                line.push_back(static_cast<int>(fibres->points.size()));
                fibres->points.emplace_back(at.x + lane * at.wide, inside, z);
            }
            fibres->lines.push_back(std::move(line));
        }
    return fibres;
}

Bone make_bone(const char* name, const ImplicitShape& shape, int triangles, int threads) {
    const Vec3 reach = Vec3::Constant(shape.radius + 4.0);
    const ImplicitField field(shape.value, {shape.centre - reach, shape.centre + reach, 1.5}, threads);
    Bone bone;
    bone.name = name;
    bone.mesh = std::make_shared<TriMesh>(mesh_implicit(shape.value, field, {triangles, 3, threads}));
    return bone;
}

Attachment attach(AttachmentKind kind, const TriMesh& mesh, int bone, const ImplicitShape& shape) {
    Attachment attachment{kind, bone, {}};
    for (int v = 0; v < mesh.vertex_count(); ++v)
        if (shape(mesh.positions[static_cast<std::size_t>(v)]) < 1.0)
            attachment.vertices.push_back(v);
    return attachment;
}

} // namespace

/// Millimetres; x across, y backwards, z up. Two heads hang from two fixed blocks, the right one lower, grow together at
/// about z = 30 into one belly, and end on a lever that turns about +x and so stretches the muscle.
Scene make_two_heads(int threads) {
    const ImplicitShape left = box_shape(Vec3(-27, -6, 110), Vec3(15, 13, 10), 3.0);
    const ImplicitShape right = box_shape(Vec3(27, -6, 94), Vec3(15, 13, 10), 3.0);
    const ImplicitShape lever = round_cone_shape(hinge_centre, Vec3(0, -42, -95), lever_radius, lever_radius);
    ImplicitUnion heads;
    heads.add(tube_shape(head_stations(-1)), 0.0).add(tube_shape(head_stations(1)), 5.0);
    const Implicit value = [=](const Vec3& p) {
        double f = heads(p);
        for (const ImplicitShape* bone : {&left, &right, &lever})
            f = smooth_max(f, clearance - (*bone)(p), 1.5);
        return f;
    };

    Scene scene;
    scene.bones = {make_bone("left_block", left, 1600, threads),
                   make_bone("right_block", right, 1600, threads), make_bone("lever", lever, 2400, threads)};
    Muscle muscle;
    muscle.name = "two_heads";
    const ImplicitField field(value, {Vec3(-46, -34, -102), Vec3(46, 18, 112), 1.5}, threads);
    muscle.mesh = std::make_shared<TriMesh>(mesh_implicit(value, field, {6000, 4, threads}));
    muscle.attach_automatically = false;
    muscle.attachments = {attach(AttachmentKind::origin, *muscle.mesh, 0, left),
                          attach(AttachmentKind::origin, *muscle.mesh, 1, right),
                          attach(AttachmentKind::insertion, *muscle.mesh, 2, lever)};
    muscle.surface_fibres = surface_fibres(value);
    scene.muscles.push_back(std::move(muscle));
    scene.timeline = make_hinge_timeline({hinge_centre, Vec3::UnitX()}, 0.6, {100, 100, 100}, 3, {2});
    return scene;
}

} // namespace fascicle::embedded
