#include "hip_shapes.hpp"

#include "fascicle/geometry/implicit_sheet.hpp"
#include "fascicle/geometry/implicit_tube.hpp"

#include <Eigen/Geometry>
#include <memory>

namespace fascicle::embedded {

namespace {

/// Direction the socket opens to: sideways, down and forward.
const Vec3 opening = Vec3(-0.72, -0.30, -0.62).normalized();

ImplicitShape wing() {
    const Vec3 out = Vec3(-1.0, 0.45, -0.45).normalized();
    const Vec3 v = (Vec3::UnitZ() - Vec3::UnitZ().dot(out) * out).normalized();
    return sheet_shape({Vec3(-15, 0, 80), v.cross(out), v},
                       {{Vec3(-25, -63, 77), 5},
                        {Vec3(-36, -54, 101), 5},
                        {Vec3(-44, -30, 127), 5.5},
                        {Vec3(-41, -3, 144), 4.5},
                        {Vec3(-32, 20, 149), 4.5},
                        {Vec3(-15, 45, 140), 5},
                        {Vec3(8, 66, 115), 6},
                        {Vec3(28, 78, 91), 7},
                        {Vec3(40, 81, 71), 6},
                        {Vec3(40, 70, 52), 5.5},
                        {Vec3(30, 45, 48), 6},
                        {Vec3(22, 24, 30), 8},
                        {Vec3(14, 18, 8), 10},
                        {Vec3(0, -18, 12), 10},
                        {Vec3(-8, -42, 36), 8},
                        {Vec3(-15, -50, 55), 5}},
                       {{Vec3(-28, -10, 95), 2.5},
                        {Vec3(-12, -8, 60), 5},
                        {Vec3(-16, 22, 92), 2.6},
                        {Vec3(-25, -35, 77), 3.5},
                        {Vec3(8, 22, 60), 6},
                        {Vec3(14, 50, 85), 7},
                        {Vec3(-34, 4, 122), 3.2},
                        {Vec3(-6, 45, 112), 4}});
}

/// Inner wall of the true pelvis, medial of the socket: from the brim down to the ischium and round the foramen.
ImplicitShape inner_plate() {
    return sheet_shape({Vec3(22, 10, 0), Vec3::UnitY(), Vec3::UnitZ()},
                       {{Vec3(24, 33, 33), 6},
                        {Vec3(22, 16, 34), 7},
                        {Vec3(21, -8, 20), 7},
                        {Vec3(24, -28, 6), 7},
                        {Vec3(24, -30, -8), 6},
                        {Vec3(20, -12, -22), 6.5},
                        {Vec3(16, 4, -34), 7},
                        {Vec3(16, 12, -54), 8},
                        {Vec3(17, 30, -60), 8},
                        {Vec3(20, 47, -38), 7},
                        {Vec3(24, 50, -8), 5.5},
                        {Vec3(25, 38, 13), 6}},
                       {{Vec3(23, 12, 6), 5.5}, {Vec3(20, 24, -24), 8}, {Vec3(24, 34, 6), 7}});
}

} // namespace

ImplicitShape iliac_shape(const ImplicitShape& sacrum) {
    auto bone = std::make_shared<ImplicitUnion>();
    bone->add(wing(), 0.0);
    // Crest: the thick upper border, an S from above.
    bone->add(tube_shape({{Vec3(-24, -64, 75), 6.5, 5.5, Vec3::UnitZ()},
                          {Vec3(-35, -55, 100), 5.5, 5.5, Vec3::UnitZ()},
                          {Vec3(-44, -30, 126), 7.5, 6, -Vec3::UnitX()},
                          {Vec3(-41, -3, 143), 6, 5, -Vec3::UnitX()},
                          {Vec3(-32, 20, 148), 5.5, 5, -Vec3::UnitX()},
                          {Vec3(-15, 45, 139), 6, 5, -Vec3::UnitX()},
                          {Vec3(8, 66, 114), 7, 6, -Vec3::UnitX()},
                          {Vec3(28, 77, 90), 7.5, 6.5, -Vec3::UnitX()},
                          {Vec3(39, 79, 72), 7, 6, -Vec3::UnitX()}}),
              5.0);
    // Thick part behind the hollow, which meets the sacrum; carved to its shape below.
    bone->add(ellipsoid_shape(Vec3(25, 45, 80), Vec3(15, 17, 21)), 14.0);
    // Lower front spine.
    bone->add(round_cone_shape(Vec3(-4, -30, 30), Vec3(-10, -45, 38), 9, 5.5), 8.0);
    // Body above the socket, and the pelvic brim from the sacro-iliac joint along the upper branch of the pubis.
    bone->add(tube_shape({{Vec3(-6, -6, 52), 16, 4, Vec3(0.4, 1, 0)},
                          {Vec3(-1, -3, 41), 21, 8, Vec3(0.4, 1, 0)},
                          {Vec3(5, 0, 28), 25, 13, Vec3(0.4, 1, 0)}}),
              14.0);
    bone->add(inner_plate(), 10.0);
    bone->add(tube_shape({{Vec3(25, 36, 54), 6, 5},
                          {Vec3(24, 18, 39), 7, 6},
                          {Vec3(22, -4, 23), 8, 7},
                          {Vec3(26, -24, 7), 10, 8},
                          {Vec3(42, -38, -7), 9, 7.5, Vec3(0.2, -0.6, 1)},
                          {Vec3(60, -48, -18), 8.5, 6.5, Vec3(0.2, -0.6, 1)},
                          {Vec3(76, -55, -28), 9, 7},
                          {Vec3(82, -55, -34), 9, 7}}),
              12.0);
    bone->add(round_cone_shape(Vec3(12, -18, -18), Vec3(44, -38, -14), 9, 6), 10.0); // roof of the foramen
    bone->add(ellipsoid_shape(Vec3(8, -30, 8), Vec3(11, 9, 10)), 12.0); // where ilium and pubis met
    // Socket: half a ball; what lies before its mouth is taken away later.
    const ImplicitShape ball = sphere_shape(Vec3(0, 1, 2), 31.0);
    bone->add({[ball](const Vec3& p) { return smooth_max(ball(p), p.dot(opening) - 2.5, 3.0); }, ball.centre,
               ball.radius},
              9.0);
    const Vec3 notch_wish(0.45, -0.35, -0.8);
    const Vec3 notch = (notch_wish - notch_wish.dot(opening) * opening).normalized();
    bone->add(ring_shape(-1.0 * opening, opening, -notch, 2.4, 29.0, 4.6), 7.0);
    // Ischium: behind the socket down to the tuberosity.
    bone->add(tube_shape({{Vec3(20, 22, 32), 9, 8, Vec3(0, 1, 0.2)},
                          {Vec3(20, 28, 12), 12, 9, Vec3(0, 1, 0)},
                          {Vec3(18, 34, -12), 15, 10, Vec3(0, 1, 0)},
                          {Vec3(14, 35, -36), 14, 12, Vec3(0, 1, 0)},
                          {Vec3(14, 30, -55), 16, 13, Vec3(0, 1, -0.3)},
                          {Vec3(19, 20, -62), 12, 10, Vec3(0, 1, -0.5)}}),
              12.0);
    bone->add(round_cone_shape(Vec3(6, 16, -24), Vec3(13, 26, -44), 11, 12), 10.0);
    bone->add(round_cone_shape(Vec3(24, 46, -6), Vec3(31, 57, -13), 7, 3), 8.0); // spine of the ischium
    // Lower branches of ischium and pubis, and the body of the pubis at the symphysis.
    bone->add(tube_shape({{Vec3(19, 20, -60), 12, 8, Vec3(0.1, 0.3, 1)},
                          {Vec3(34, 2, -62), 9.5, 5.5, Vec3(0.1, 0.3, 1)},
                          {Vec3(52, -18, -61), 8.5, 4.8, Vec3(0.1, 0.3, 1)},
                          {Vec3(67, -36, -56), 9, 5.2, Vec3(0.3, 0, 1)},
                          {Vec3(76, -47, -47), 10, 6.5, Vec3(0.6, 0, 1)}}),
              10.0);
    bone->add(tube_shape({{Vec3(76, -55, -28), 13, 7, Vec3(1, 0, 0)},
                          {Vec3(76, -53, -40), 13, 7, Vec3(1, 0, 0)},
                          {Vec3(78, -47, -54), 10, 6, Vec3(1, 0, 0)}}),
              8.0);
    const ImplicitShape mouth = round_cone_shape(Vec3::Zero(), 45.0 * opening, socket_radius, 29);
    const ImplicitShape fossa =
        round_cone_shape(-20.0 * opening + 4.0 * notch, -11.0 * opening + 17.0 * notch, 7, 7);
    const ImplicitShape gap =
        round_cone_shape(29.0 * notch + 2.0 * opening, 42.0 * notch + 10.0 * opening, 5, 8);
    const auto value = [=](const Vec3& p) {
        double f = (*bone)(p);
        if (const double r = p.norm(); r < 60.0) {
            // Room for the head of the femur and, before it, for the neck.
            f = smooth_max(f, -mouth(p), 2.5);
            f = smooth_max(f, -fossa(p), 3.0);
            f = smooth_max(f, -gap(p), 4.0);
        }
        f = smooth_max(f, p.x() - (midline_x - 2.5), 2.0); // symphysis: half of its cartilage
        if (p.x() > 15.0 && p.z() > 20.0)
            f = smooth_max(f, 1.2 - sacrum(p), 2.0);
        return f;
    };
    return {value, Vec3(15, 5, 42), 155};
}

} // namespace fascicle::embedded
