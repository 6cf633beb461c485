#pragma once
// Small bodies among solids, for tests of the rival methods.

#include "fascicle/geometry/distance_grid.hpp"
#include "fascicle/solver/parameters.hpp"
#include "fascicle/solver/soft_body_solver.hpp"
#include "support/shapes.hpp"

#include <algorithm>

namespace fascicle::test {

inline Points moved(const Points& points, const Pose& pose) {
    Points result;
    for (const Vec3& p : points)
        result.push_back(pose.apply(p));
    return result;
}

inline double farthest(const Points& a, const Points& b) {
    double result = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        result = std::max(result, (a[i] - b[i]).norm());
    return result;
}

inline SoftBodyProblem free_ball(const std::string& method, int levels = 3) {
    SoftBodyProblem problem;
    problem.surface = std::make_shared<TriMesh>(sphere(10, levels));
    problem.body_of_vertex.assign(problem.surface->positions.size(), -1);
    set_method(problem.parameters, method);
    return problem;
}

/// A ball of radius 10 whose lower cap belongs to solid 0 and whose upper cap to solid 1, if there is one; they are far away.
inline SoftBodyProblem held_ball(const std::string& method, int solids, int levels = 3) {
    SoftBodyProblem problem = free_ball(method, levels);
    DistanceGridOptions options;
    options.spacing = 2;
    for (int b = 0; b < solids; ++b) {
        auto mesh = std::make_shared<TriMesh>(box(4, 4, 4));
        for (Vec3& p : mesh->positions)
            p += Vec3(100, 100 * b, -100);
        problem.solids.push_back({mesh, std::make_shared<DistanceGrid>(*mesh, options)});
    }
    for (std::size_t i = 0; i < problem.body_of_vertex.size(); ++i)
        if (problem.surface->positions[i].z() < -8)
            problem.body_of_vertex[i] = 0;
        else if (solids > 1 && problem.surface->positions[i].z() > 8)
            problem.body_of_vertex[i] = 1;
    return problem;
}

/// A free ball of radius 10 between a plate below -10.3 (solid 0) and one above 10.3 (solid 1).
inline SoftBodyProblem squeezed_ball(const std::string& method, int threads) {
    SoftBodyProblem problem = free_ball(method);
    problem.threads = threads;
    DistanceGridOptions options;
    for (const double z : {-30.0, 10.3}) {
        auto plate = std::make_shared<TriMesh>(box(80, 80, 19.7));
        for (Vec3& p : plate->positions)
            p += Vec3(-40, -40, z);
        problem.solids.push_back({plate, std::make_shared<DistanceGrid>(*plate, options)});
    }
    return problem;
}

inline void hold(SoftBodySolver& solver, const std::vector<Pose>& poses, int frames) {
    for (int f = 0; f < frames; ++f)
        solver.advance(poses, poses);
}

/// Brings the upper plate of squeezed_ball() down by `step` a frame. Where the plates are then.
inline std::vector<Pose> squeeze(SoftBodySolver& solver, int frames, double step) {
    std::vector<Pose> from(2), to(2);
    for (int f = 1; f <= frames; ++f) {
        to[1].translation = Vec3(0, 0, -step * f);
        solver.advance(from, to);
        from = to;
    }
    return to;
}

} // namespace fascicle::test
