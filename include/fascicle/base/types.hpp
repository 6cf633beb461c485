#pragma once
// The few number types that every module shares. Lengths are in scene units (mm or m) unless a name says
// otherwise.

#include <Eigen/Core>
#include <Eigen/Geometry> // without it cross() compiles and does not link
#include <array>
#include <vector>

namespace fascicle {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// Three vertex indices, counter-clockwise seen from outside.
using Tri = std::array<int, 3>;

/// One point per vertex.
using Points = std::vector<Vec3>;

} // namespace fascicle
