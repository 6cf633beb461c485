#include "solver/rivals/mass_spring/particles.hpp"

#include "fascicle/geometry/volume.hpp"
#include "solver/rivals/mass_spring/point_cells.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

namespace fascicle::mass_spring {

namespace {

std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

/// S of the header as xx, yy, zz, xy, xz, yz; largest eigenvector, or zero when the fit says nothing.
Vec3 fitted_direction(const TriMesh& surface, const MeshTopology& topology,
                      const std::vector<double>& along) {
    using Row = Eigen::Matrix<double, 6, 1>;
    Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
    Row right = Row::Zero();
    for (std::size_t e = 0; e < along.size(); ++e) {
        const Edge& edge = topology.edges()[e];
        const Vec3 d = surface.positions[at(edge.b)] - surface.positions[at(edge.a)];
        const double l2 = d.squaredNorm();
        if (!(l2 > 0.0))
            continue;
        Row row;
        row << d.x() * d.x(), d.y() * d.y(), d.z() * d.z(), 2 * d.x() * d.y(), 2 * d.x() * d.z(),
            2 * d.y() * d.z();
        row /= l2;
        normal += l2 * row * row.transpose();
        right += l2 * along[e] * row;
    }
    const Row s = normal.completeOrthogonalDecomposition().solve(right);
    if (!s.allFinite())
        return Vec3::Zero();
    Mat3 m;
    m << s[0], s[3], s[4], s[3], s[1], s[5], s[4], s[5], s[2];
    const Eigen::SelfAdjointEigenSolver<Mat3> eigen(m);
    // One direction has to stand out, or its sign and place are noise.
    constexpr double clearly = 0.1;
    if (!(eigen.eigenvalues()[2] - eigen.eigenvalues()[1] > clearly))
        return Vec3::Zero();
    return eigen.eigenvectors().col(2);
}

} // namespace

Mat3 lattice_axes(const TriMesh& surface, const MeshTopology& topology, const std::vector<double>& along) {
    const Vec3 centre = surface_centroid(surface.positions, surface.triangles);
    Mat3 moments = Mat3::Zero();
    for (std::size_t i = 0; i < surface.positions.size(); ++i)
        if (topology.vertex_component(static_cast<int>(i)) >= 0) {
            const Vec3 d = surface.positions[i] - centre;
            moments += d * d.transpose();
        }
    const double size = moments.trace();
    if (!(size > 0.0) || !std::isfinite(size))
        return Mat3::Identity();
    Vec3 first = fitted_direction(surface, topology, along);
    if (first.isZero(0.0))
        first = Eigen::SelfAdjointEigenSolver<Mat3>(moments / size).eigenvectors().col(2);
    const Mat3 across = Mat3::Identity() - first * first.transpose();
    // The line direction has eigenvalue 0 here, so it is the last of three wanted.
    const Eigen::SelfAdjointEigenSolver<Mat3> plane(across * moments * across / size -
                                                    first * first.transpose());
    Mat3 axes;
    axes.col(0) = first;
    axes.col(1) = plane.eigenvectors().col(2);
    axes.col(2) = axes.col(0).cross(axes.col(1));
    return axes;
}

double spacing_for(double volume, double area, int wanted) {
    if (!(area > 0.0) || !std::isfinite(area) || !std::isfinite(volume))
        return 0.0;
    const auto count = [&](double h) {
        return std::max(0.0, volume - inner_depth * h * area) / (h * h * h) + 1.1 * area / (h * h);
    };
    double low = 1e-6 * std::sqrt(area), high = 4.0 * std::sqrt(area);
    for (int k = 0; k < 60; ++k) {
        const double middle = std::sqrt(low * high);
        (count(middle) > wanted ? low : high) = middle;
    }
    return high;
}

ParticleSet sample_particles(const TriMesh& surface, const MeshTopology& topology,
                             std::span<const int> body_of_vertex, const SolidQuery& solid, const Mat3& axes,
                             int wanted, std::span<const int> extra) {
    constexpr double apart = 0.8, bodies_apart = 0.5; // of the spacing
    ParticleSet set;
    set.axes = axes;
    const double h = set.spacing = spacing_for(std::abs(signed_volume(surface.positions, surface.triangles)),
                                               surface_area(surface.positions, surface.triangles), wanted);
    const std::size_t count = surface.positions.size();
    std::vector<char> chosen(count, 0);
    if (h > 0.0) {
        std::map<int, PointCells> of_body;
        // Attached ones first: they are what holds the rest.
        for (const bool attached : {true, false})
            for (std::size_t i = 0; i < count; ++i) {
                const int body = body_of_vertex[i];
                if ((body >= 0) != attached || topology.vertex_component(static_cast<int>(i)) < 0)
                    continue;
                const Vec3& p = surface.positions[i];
                auto& own = of_body.try_emplace(body, apart * h).first->second;
                bool far = !own.any_nearer(p, apart * h);
                if (own.size() > 0)
                    for (const auto& [other, points] : of_body)
                        far = far && (other == body || !points.any_nearer(p, bodies_apart * h));
                if (far) {
                    own.add(p);
                    chosen[i] = 1;
                }
            }
    } else {
        for (std::size_t i = 0; i < count; ++i)
            chosen[i] = topology.vertex_component(static_cast<int>(i)) >= 0;
    }
    for (const int vertex : extra)
        chosen[at(vertex)] = 1;
    Vec3 low = Vec3::Zero(), high = Vec3::Zero();
    const Vec3 centre = surface_centroid(surface.positions, surface.triangles);
    for (std::size_t i = 0; i < count; ++i) {
        if (topology.vertex_component(static_cast<int>(i)) < 0)
            continue;
        const Vec3 q = axes.transpose() * (surface.positions[i] - centre);
        low = low.cwiseMin(q);
        high = high.cwiseMax(q);
        if (chosen[i] != 0) {
            set.rest.push_back(surface.positions[i]);
            set.vertex.push_back(static_cast<int>(i));
        }
    }
    if (!(h > 0.0))
        return set;
    const Vec3 first = (low / h).array().ceil(), last = (high / h).array().floor();
    // A body that fills so little of its box has no inside at this spacing.
    constexpr double most_nodes = 4e6;
    if ((last - first + Vec3::Ones()).prod() > most_nodes)
        return set;
    int hint = -1;
    for (double k = first.z(); k <= last.z(); ++k)
        for (double j = first.y(); j <= last.y(); ++j)
            for (double i = first.x(); i <= last.x(); ++i) {
                const Vec3 p = centre + axes * (h * Vec3(i, j, k));
                const double depth = inner_depth * h;
                if (solid.beyond_box(p) || solid.signed_distance(p, depth, hint) > -(1.0 - 1e-9) * depth)
                    continue;
                set.rest.push_back(p);
                set.vertex.push_back(-1);
            }
    return set;
}

} // namespace fascicle::mass_spring
