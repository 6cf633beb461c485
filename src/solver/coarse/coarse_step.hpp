#pragma once
// The numbers that the coarse correction goes by, the same in the plain and in the fast kernel. Measured: docs/convergence.md.

#include <cstdint>

namespace fascicle::solver {

/// One in so many edges and hinges measures the curvature along a step, other ones each time.
inline constexpr std::uint32_t curvature_stride = 4;
/// Where a cluster has so many free vertices, only every second edge and every fourth hinge makes the matrix, other ones each time;
/// where it has fewer, every edge and every second hinge. Smooth movements strain neighbours alike, and hinges cost most and
/// weigh less.
inline constexpr double many_members = 60.0;
/// By how much the matrix exceeds the curvature at the shape it is made for, so that it still does when it is older.
inline constexpr double matrix_safety = 2.0;
/// Longest step, of the one that the matrix asks for. Not more than 1, though the matrix is large: where inertia rules,
/// it would be too far.
inline constexpr double longest_step = 1.0;
/// A step that had to be shortened to this asks for a new matrix.
inline constexpr double short_step = 0.3;
/// So do neighbouring clusters that have turned against each other by this in the mean (rms): the more substeps a frame, the
/// more exact the shape is wanted to be and the less a matrix weighs among them.
inline constexpr double far_bend_rad(int substeps) {
    return 0.3 / (substeps > 3 ? substeps : 3);
}
/// Substeps that a matrix is kept at least.
inline constexpr int least_matrix_age = 3;

} // namespace fascicle::solver
