#include "hip_shapes.hpp"

#include "fascicle/geometry/implicit_tube.hpp"

#include <memory>

namespace fascicle::embedded {

namespace {

const Vec3 front = -Vec3::UnitY();

ImplicitShape shaft() {
    return tube_shape({{Vec3(-43, 12, -30), 18, 14, Vec3::UnitX()},
                       {Vec3(-41, 13, -52), 18, 15, Vec3::UnitX()},
                       {Vec3(-39, 12, -80), 15.5, 14.5, Vec3::UnitX()},
                       {Vec3(-37, 7, -130), 13.5, 13.5, Vec3::UnitX()},
                       {Vec3(-34, 3, -195), 13.2, 13.2, Vec3::UnitX()},
                       {Vec3(-30, 3, -260), 14, 13.5, Vec3::UnitX()},
                       {Vec3(-25, 7, -315), 18, 15, Vec3::UnitX()},
                       {Vec3(-21, 11, -350), 26, 17, Vec3::UnitX()},
                       {Vec3(-19, 14, -372), 34, 18, Vec3::UnitX()},
                       {Vec3(-19, 15, -382), 33, 17, Vec3::UnitX()}},
                      6);
}

/// One roller of the knee: from the front of the joint below to its back.
ImplicitShape condyle(double x_front, double x_back, double lower, double radius) {
    return tube_shape(
        {{Vec3(x_front, -8, -364), radius - 2, radius - 3, Vec3::UnitX()},
         {Vec3(0.7 * x_front + 0.3 * x_back, -5, -383 - lower), radius - 1, radius, Vec3::UnitX()},
         {Vec3(0.4 * x_front + 0.6 * x_back, 14, -390 - lower), radius, radius, Vec3::UnitX()},
         {Vec3(x_back, 34, -386 - lower), radius, radius + 1, Vec3::UnitX()},
         {Vec3(x_back, 42, -370 - lower), radius - 2, radius, Vec3::UnitX()}},
        6);
}

} // namespace

ImplicitShape femur_shape() {
    auto bone = std::make_shared<ImplicitUnion>();
    bone->add(shaft(), 0.0);
    // Neck: higher than deep, narrowest in the middle.
    const Vec3 down(-0.6, 0.1, 0.78);
    bone->add(tube_shape({{Vec3(-8, 2, -6), 19, 18, down},
                          {Vec3(-19, 4.5, -15), 17, 13.5, down},
                          {Vec3(-28, 7, -22), 17, 13, down},
                          {Vec3(-40, 10, -34), 22, 15, down},
                          {Vec3(-44, 11, -42), 22, 15, down}}),
              7.0);
    bone->add(sphere_shape(Vec3::Zero(), head_radius), 3.0);
    // Greater trochanter: a four-sided crest whose tip leans back and in over the trochanteric fossa.
    bone->add(tube_shape({{Vec3(-40, 9, -150), 6, 4, front},
                          {Vec3(-45, 12, -105), 10, 5, front},
                          {Vec3(-50, 12, -72), 14, 8, front},
                          {Vec3(-56, 12, -44), 18, 10.5, front},
                          {Vec3(-58, 14, -26), 18, 10, front},
                          {Vec3(-56, 18, -13), 14, 9, front},
                          {Vec3(-54, 22, -8), 10, 7.5, front}}),
              9.0);
    // Intertrochanteric crest behind, from the tip down to the lesser trochanter.
    bone->add(tube_shape({{Vec3(-55, 25, -12), 6, 6},
                          {Vec3(-49, 29, -26), 6, 6},
                          {Vec3(-39, 27, -46), 6, 6},
                          {Vec3(-28, 25, -60), 6, 6}}),
              8.0);
    bone->add(round_cone_shape(Vec3(-34, 17, -62), Vec3(-22, 26, -60), 11, 7.5), 10.0);
    // Intertrochanteric line in front.
    bone->add(
        tube_shape({{Vec3(-56, 1, -24), 4, 4}, {Vec3(-44, -1, -44), 3.5, 3.5}, {Vec3(-30, 5, -64), 3, 3}}),
        7.0);
    // Linea aspera: from the gluteal tuberosity down the back of the shaft, dying out towards the knee.
    bone->add(tube_shape({{Vec3(-46, 24, -68), 4, 3.5},
                          {Vec3(-42, 23, -110), 3.5, 3},
                          {Vec3(-36, 18, -160), 3, 3},
                          {Vec3(-33, 16, -215), 3, 3},
                          {Vec3(-29, 16, -265), 2.5, 2.5},
                          {Vec3(-27, 16, -295), 2, 2}}),
              7.0);
    bone->add(ellipsoid_shape(Vec3(-19.5, 14, -378), Vec3(37, 21, 16)), 12.0);
    bone->add(condyle(-7, 4, 2, 13), 12.0);
    bone->add(condyle(-32, -43, 0, 13), 12.0);
    bone->add(ellipsoid_shape(Vec3(9, 17, -370), Vec3(11, 16, 17)), 14.0);
    bone->add(ellipsoid_shape(Vec3(-48, 17, -371), Vec3(10, 15, 16)), 14.0);

    const ImplicitShape fossa = round_cone_shape(Vec3(-38, 28, -14), Vec3(-48, 18, -17), 8, 4);
    const ImplicitShape fovea = sphere_shape(Vec3(24.5, 5, -12), 6.5);
    const ImplicitShape notch = round_cone_shape(Vec3(-19.5, 56, -394), Vec3(-19.5, 20, -397), 12, 8.5);
    const ImplicitShape groove = round_cone_shape(Vec3(-21, -31, -362), Vec3(-20, -25, -392), 13, 13);
    const auto value = [=](const Vec3& p) {
        double f = (*bone)(p);
        for (const ImplicitShape* cut : {&fossa, &fovea, &notch, &groove})
            if ((p - cut->centre).norm() < cut->radius + 20.0)
                f = smooth_max(f, -(*cut)(p), 4.0);
        return f;
    };
    return {value, Vec3(-20, 10, -190), 235};
}

} // namespace fascicle::embedded
