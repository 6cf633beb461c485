#include "hip_shapes.hpp"

#include "fascicle/geometry/implicit_sheet.hpp"
#include "fascicle/geometry/implicit_tube.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace fascicle::embedded {

namespace {

constexpr double clearance = 0.5; ///< between muscle and bone where they touch

/// Bundles of fibres show as shallow grooves: the surface goes in and out by `depth` with a bundle per unit of `phase`.
double groove(double phase, double depth) {
    return depth * std::cos(2.0 * 3.14159265358979323846 * phase);
}

ImplicitShape clear_of_bones(const ImplicitShape& muscle, const HipBones& bones) {
    const auto value = [=](const Vec3& p) {
        double f = muscle(p);
        if (f > 12.0) // far outside; carving bones away cannot bring the surface nearer
            return f;
        for (const Implicit* bone : {&bones.iliac, &bones.sacrum, &bones.femur})
            f = smooth_max(f, clearance - (*bone)(p), 1.5);
        return f;
    };
    return {value, muscle.centre, muscle.radius};
}

/// A station on the bone: from `about` the point is moved 40 mm against `inward`, then along it until the sheet bites
/// `bite` deep into the bone, whose surface it then follows.
SheetStation rest_on(const Implicit& bone, const Vec3& inward, const Vec3& about, double half_thickness,
                     double bite) {
    Vec3 p = about - 40.0 * inward;
    for (int step = 0; step < 80; ++step) {
        const double gap = bone(p) - (half_thickness - bite);
        if (gap < 0.01)
            break;
        p += std::min(0.8 * gap, 4.0) * inward;
    }
    return {p, half_thickness};
}

} // namespace

ImplicitShape gluteus_maximus_shape(const HipBones& bones) {
    const Vec3 out = Vec3(-0.55, 0.83, 0.05).normalized();
    const Vec3 v = (Vec3::UnitZ() - Vec3::UnitZ().dot(out) * out).normalized();
    const auto on = [&](const Implicit& bone, double x, double y, double z, double half) {
        return rest_on(bone, -out, Vec3(x, y, z), half, 1.5);
    };
    const ImplicitShape sheet = sheet_shape({Vec3(0, 65, 0), v.cross(out), v},
                                            {on(bones.iliac, 4, 66, 116, 3),
                                             on(bones.iliac, 24, 78, 100, 4),
                                             on(bones.iliac, 40, 82, 76, 4.5),
                                             on(bones.sacrum, 62, 78, 52, 4.5),
                                             on(bones.sacrum, 72, 88, 26, 4.5),
                                             on(bones.sacrum, 82, 88, -2, 5),
                                             {Vec3(74, 86, -30), 8},
                                             {Vec3(46, 84, -66), 11},
                                             {Vec3(10, 72, -100), 11},
                                             {Vec3(-22, 50, -128), 7},
                                             on(bones.femur, -40, 28, -146, 3.5),
                                             on(bones.femur, -54, 24, -130, 3.5),
                                             {Vec3(-65, 18, -90), 4},
                                             {Vec3(-75, 18, -45), 4.5},
                                             {Vec3(-75, 30, -5), 5},
                                             {Vec3(-60, 44, 42), 6},
                                             {Vec3(-36, 58, 88), 6},
                                             {Vec3(-12, 64, 114), 4}},
                                            {on(bones.iliac, 16, 70, 98, 6),
                                             on(bones.iliac, 28, 74, 76, 6.5),
                                             on(bones.iliac, 35, 77, 62, 6),
                                             on(bones.sacrum, 56, 76, 44, 7),
                                             on(bones.sacrum, 67, 85, 16, 7),
                                             on(bones.femur, -44, 26, -112, 6),
                                             on(bones.femur, -46, 26, -90, 7.5),
                                             on(bones.femur, -60, 20, -30, 7),
                                             {Vec3(-6, 80, 62), 12.5},
                                             {Vec3(26, 92, 30), 15},
                                             {Vec3(38, 94, -14), 17},
                                             {Vec3(-10, 80, 5), 16.5},
                                             {Vec3(-42, 60, 5), 12},
                                             {Vec3(10, 84, -45), 18},
                                             {Vec3(-26, 58, -70), 15}});
    // The bundles run down and sideways, about parallel, each a little different in width.
    const Vec3 fibre = Vec3(-107, -60, -95).normalized();
    const Vec3 across = out.cross(fibre).normalized();
    const auto grooved = [=](const Vec3& p) {
        const double s = p.dot(across), along = p.dot(fibre);
        return sheet(p) + groove(s / 14.0 + 0.25 * std::sin(s / 9.0 + along / 70.0), 0.42);
    };
    return clear_of_bones({grooved, sheet.centre, sheet.radius}, bones);
}

ImplicitShape iliacus_shape(const HipBones& bones) {
    const Vec3 out = Vec3(-1.0, 0.45, -0.45).normalized();
    const Vec3 v = (Vec3::UnitZ() - Vec3::UnitZ().dot(out) * out).normalized();
    const auto at = [&](double x, double y, double z, double half) {
        return rest_on(bones.iliac, out, Vec3(x, y, z), half, 1.5);
    };
    ImplicitUnion muscle;
    muscle.add(
        sheet_shape({Vec3(-15, 0, 80), v.cross(out), v},
                    {at(-20, -50, 82, 3.5), at(-29, -43, 102, 3), at(-34, -24, 120, 3), at(-32, -2, 132, 3),
                     at(-22, 16, 135, 3), at(-10, 31, 124, 3), at(2, 33, 104, 3.5), at(8, 27, 84, 4),
                     at(13, 20, 66, 5), at(15, 9, 50, 6), at(15, -8, 34, 7), at(9, -26, 26, 7.5),
                     at(-4, -42, 34, 6.5), at(-14, -50, 58, 5)},
                    {at(-28, -10, 95, 5.5), at(-12, -12, 62, 8), at(-14, 14, 90, 6), at(-23, -32, 80, 6.5),
                     at(-30, 4, 118, 4), at(2, 8, 66, 6.5)}),
        0.0);
    muscle.add(tube_shape({{Vec3(-8, -14, 72), 17, 5, Vec3(0.4, 1, 0)},
                           {Vec3(2, -27, 48), 20, 7.5, Vec3(0.6, 0.8, 0)},
                           {Vec3(7, -41, 27), 18, 9, Vec3(1, 0.4, 0)},
                           {Vec3(4, -46, 6), 16.5, 9.5, Vec3(1, 0.2, 0)},
                           {Vec3(-1, -40, -16), 14.5, 9.5, Vec3(1, -0.1, 0)},
                           {Vec3(-7, -26, -36), 11, 8.5, Vec3(1, -0.2, -0.2)},
                           {Vec3(-12, -6, -51), 9, 7, Vec3(1, -0.3, -0.4)},
                           {Vec3(-15, 12, -61), 9, 6, Vec3(0.5, -0.4, -1)},
                           {Vec3(-17, 26, -65), 8, 5.5, Vec3(0.2, -0.3, -1)}}),
               16.0);
    // The bundles gather towards the front of the joint; there they are too fine to be seen.
    const Vec3 u = v.cross(out), gather(2, -44, 8);
    const auto grooved = [=](const Vec3& p) {
        const Vec3 q = p - gather;
        const double x = q.dot(u), y = q.dot(v), r = std::hypot(x, y);
        const double fade = std::clamp((r - 35.0) / 35.0, 0.0, 1.0);
        const double angle = std::atan2(x, y);
        return muscle(p) +
               (fade > 0.0 ? groove(6.5 * angle + 0.2 * std::sin(9.0 * angle), 0.45 * fade) : 0.0);
    };
    return clear_of_bones({grooved, Vec3(0, -5, 35), 125}, bones);
}

} // namespace fascicle::embedded
