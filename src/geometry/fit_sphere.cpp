#include "fascicle/geometry/fit_sphere.hpp"

#include "fascicle/geometry/bounding_box.hpp"
#include "fascicle/geometry/bvh.hpp"
#include "fascicle/geometry/mesh_topology.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace fascicle {
namespace {

std::size_t z(int i) {
    return static_cast<std::size_t>(i);
}

/// Area vectors (area times unit normal) of the vertices: a third of those of their triangles.
Points vertex_areas(const TriMesh& mesh) {
    Points areas(mesh.positions.size(), Vec3::Zero());
    for (const Tri& t : mesh.triangles) {
        const Vec3 a = mesh.positions[z(t[0])];
        const Vec3 n = (mesh.positions[z(t[1])] - a).cross(mesh.positions[z(t[2])] - a) / 6.0;
        for (const int v : t)
            areas[z(v)] += n;
    }
    return areas;
}

/// The moving bone's vertices nearest to the fixed bones: at least 60, and all that are at most 1 % of the bone's size
/// further away than the nearest one.
std::vector<int> seed_patch(const TriMesh& moving, const MeshTopology& topology,
                            const std::vector<const TriMesh*>& fixed, double& clearance) {
    std::vector<TriangleBvh> trees;
    for (const TriMesh* mesh : fixed)
        trees.emplace_back(*mesh);
    const double size = bounding_box(moving.positions, moving.triangles).diagonal();
    std::vector<std::pair<double, int>> near;
    for (int v = 0; v < moving.vertex_count(); ++v) {
        if (topology.vertex_triangles(v).empty())
            continue;
        double best = 0.15 * size;
        for (const TriangleBvh& tree : trees)
            if (const SurfacePoint foot = tree.closest(moving.positions[z(v)], best); foot.triangle >= 0)
                best = std::sqrt(foot.squared_distance);
        if (best < 0.15 * size)
            near.emplace_back(best, v);
    }
    std::sort(near.begin(), near.end());
    std::vector<int> patch;
    for (const auto& [distance, v] : near)
        if (patch.size() < 60 || distance <= near[0].first + 0.01 * size)
            patch.push_back(v);
    clearance = near.empty() ? 0.0 : near[0].first;
    return patch;
}

/// Vertices on the ball, the largest patch of them that hangs together.
std::vector<int> head_patch(const TriMesh& mesh, const MeshTopology& topology, const Points& areas,
                            const Sphere& ball) {
    std::vector<char> on(mesh.positions.size(), 0);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const Vec3 radial = mesh.positions[z(v)] - ball.centre;
        const double length = radial.norm(), area = areas[z(v)].norm();
        on[z(v)] = std::abs(length - ball.radius) < 0.06 * ball.radius && area > 0.0 &&
                   radial.dot(areas[z(v)]) > std::cos(25.0 * std::numbers::pi / 180.0) * length * area;
    }
    std::vector<int> largest, patch;
    for (int seed = 0; seed < mesh.vertex_count(); ++seed) {
        if (!on[z(seed)])
            continue;
        on[z(seed)] = 0;
        patch.assign(1, seed);
        for (std::size_t i = 0; i < patch.size(); ++i)
            for (const int n : topology.vertex_neighbours(patch[i]))
                if (on[z(n)]) {
                    on[z(n)] = 0;
                    patch.push_back(n);
                }
        if (patch.size() > largest.size())
            largest.swap(patch);
    }
    std::sort(largest.begin(), largest.end());
    return largest;
}

Points gathered(const TriMesh& mesh, const std::vector<int>& vertices) {
    Points out;
    for (const int v : vertices)
        out.push_back(mesh.positions[z(v)]);
    return out;
}

} // namespace

std::optional<Sphere> fit_sphere(const Points& points) {
    if (points.size() < 4)
        return std::nullopt;
    Vec3 mean = Vec3::Zero();
    for (const Vec3& p : points)
        mean += p / static_cast<double>(points.size());
    // |y|^2 = 2 c.y + (r^2 - |c|^2), y = x - mean: normal equations, whose 3x3 part is the points' covariance.
    Mat3 covariance = Mat3::Zero();
    Vec3 right = Vec3::Zero();
    double squares = 0.0;
    for (const Vec3& p : points) {
        const Vec3 y = p - mean;
        covariance += y * y.transpose();
        right += 0.5 * y.squaredNorm() * y;
        squares += y.squaredNorm() / static_cast<double>(points.size());
    }
    const Eigen::SelfAdjointEigenSolver<Mat3> eigen(covariance);
    if (!(eigen.eigenvalues()[0] > 1e-9 * eigen.eigenvalues()[2]))
        return std::nullopt;
    Vec3 centre = covariance.ldlt().solve(right);
    double radius = std::sqrt(squares + centre.squaredNorm());
    for (int round = 0; round < 20; ++round) {
        Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
        Eigen::Vector4d slope = Eigen::Vector4d::Zero();
        for (const Vec3& p : points) {
            const Vec3 d = p - mean - centre;
            const double length = d.norm();
            if (length == 0.0)
                continue;
            Eigen::Vector4d row;
            row << -d / length, -1.0;
            normal += row * row.transpose();
            slope += row * (length - radius);
        }
        const Eigen::Vector4d step = normal.ldlt().solve(slope);
        if (!step.allFinite())
            break;
        centre -= step.head<3>();
        radius -= step[3];
        if (step.norm() < 1e-12 * radius)
            break;
    }
    if (!(radius > 0.0) || !centre.allFinite())
        return std::nullopt;
    return Sphere{mean + centre, radius};
}

std::optional<JointFit> fit_joint_centre(const TriMesh& moving, const std::vector<const TriMesh*>& fixed) {
    const MeshTopology topology(moving.vertex_count(), moving.triangles);
    const Points areas = vertex_areas(moving);
    JointFit fit;
    std::vector<int> patch = seed_patch(moving, topology, fixed, fit.clearance);
    for (int round = 0; round < 60; ++round) {
        const auto ball = fit_sphere(gathered(moving, patch));
        if (!ball)
            return std::nullopt;
        fit.head = *ball;
        std::vector<int> next = head_patch(moving, topology, areas, *ball);
        if (next == patch)
            break;
        patch = std::move(next);
    }
    double area = 0.0, squares = 0.0;
    for (const int v : patch) {
        const double miss = (moving.positions[z(v)] - fit.head.centre).norm() - fit.head.radius;
        squares += miss * miss;
        area += areas[z(v)].norm();
    }
    const double r = fit.head.radius;
    fit.vertices = static_cast<int>(patch.size());
    fit.rms = patch.empty() ? 0.0 : std::sqrt(squares / static_cast<double>(patch.size()));
    fit.coverage = area / (4.0 * std::numbers::pi * r * r);
    const double size = bounding_box(moving.positions, moving.triangles).diagonal();
    if (fit.vertices < 50 || fit.rms > 0.03 * r || fit.coverage < 0.15 || r > 0.5 * size)
        return std::nullopt;
    return fit;
}

} // namespace fascicle
