#include "patch_surface.hpp"

#include "hash_random.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace fascicle::chmd {

namespace {

const Vec3& corner(const Points& positions, const Tri& t, std::size_t k) {
    return positions[static_cast<std::size_t>(t[k])];
}

/// The two directions in which the points spread most, as columns.
Eigen::Matrix<double, 3, 2> principal_plane(const Points& points) {
    Vec3 mean = Vec3::Zero();
    for (const Vec3& p : points)
        mean += p;
    mean /= static_cast<double>(points.size());
    Mat3 spread = Mat3::Zero();
    for (const Vec3& p : points)
        spread += (p - mean) * (p - mean).transpose();
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(spread);
    Eigen::Matrix<double, 3, 2> plane;
    plane << solver.eigenvectors().col(2), solver.eigenvectors().col(1);
    for (Eigen::Index k = 0; k < 2; ++k) { // their signs are arbitrary: the longest component is positive
        Eigen::Index longest = 0;
        plane.col(k).cwiseAbs().maxCoeff(&longest);
        if (plane(longest, k) < 0.0)
            plane.col(k) *= -1.0;
    }
    return plane;
}

/// Place of a cell along Hilbert's curve over 2^10 x 2^10 cells: neighbours on it are neighbours in the plane.
unsigned hilbert_place(unsigned x, unsigned y) {
    unsigned place = 0;
    for (unsigned s = 512; s > 0; s /= 2) {
        const unsigned rx = (x & s) != 0 ? 1 : 0, ry = (y & s) != 0 ? 1 : 0;
        place += s * s * ((3 * rx) ^ ry);
        if (ry == 0) {
            if (rx == 1) {
                x = 1023 - x;
                y = 1023 - y;
            }
            std::swap(x, y);
        }
    }
    return place;
}

/// Triangle numbers along the curve.
std::vector<std::size_t> curve_order(const Points& positions, const std::vector<Tri>& triangles) {
    Points centres;
    for (const Tri& t : triangles)
        centres.emplace_back((corner(positions, t, 0) + corner(positions, t, 1) + corner(positions, t, 2)) /
                             3.0);
    const auto plane = principal_plane(centres);
    Vec2 low = Vec2::Constant(1e300), high = -low;
    std::vector<Vec2> flat;
    for (const Vec3& c : centres) {
        flat.emplace_back(plane.transpose() * c);
        low = low.cwiseMin(flat.back());
        high = high.cwiseMax(flat.back());
    }
    const double size = std::max((high - low).maxCoeff(), 1e-300);
    std::vector<unsigned> place;
    for (const Vec2& p : flat) {
        const Vec2 q =
            ((p - low) / size * 1019.53).array() + 1.37; // regular meshes do not fall on the cells' borders
        place.push_back(hilbert_place(static_cast<unsigned>(q.x()), static_cast<unsigned>(q.y())));
    }
    std::vector<std::size_t> order(triangles.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return place[a] != place[b] ? place[a] < place[b] : a < b;
    });
    return order;
}

} // namespace

PatchSurface make_patch_surface(const FibreProblem& problem, AttachmentKind kind) {
    PatchSurface surface;
    std::vector<char> in_patch(problem.surface->positions.size());
    for (const AttachmentPatch& patch : problem.patches) {
        if (patch.kind != kind)
            continue;
        std::fill(in_patch.begin(), in_patch.end(), char{0});
        for (const int v : patch.vertices)
            in_patch[static_cast<std::size_t>(v)] = 1;
        const std::size_t before = surface.triangles.size();
        for (const Tri& t : problem.surface->triangles)
            if (in_patch[static_cast<std::size_t>(t[0])] && in_patch[static_cast<std::size_t>(t[1])] &&
                in_patch[static_cast<std::size_t>(t[2])])
                surface.triangles.push_back(t);
        if (surface.triangles.size() == before)
            for (const int v : patch.vertices)
                surface.triangles.push_back({v, v, v});
    }
    surface.bvh = TriangleBvh(problem.surface->positions, surface.triangles);
    return surface;
}

Points sample_patch(const Points& positions, const std::vector<Tri>& triangles, int count, unsigned seed) {
    const std::vector<std::size_t> order = curve_order(positions, triangles);
    std::vector<double> until(order.size());
    double sum = 0;
    for (const bool alike : {false, true}) {
        for (std::size_t i = 0; i < order.size(); ++i) {
            const Tri& t = triangles[order[i]];
            const Vec3 &a = corner(positions, t, 0), &b = corner(positions, t, 1),
                       &c = corner(positions, t, 2);
            sum += alike ? 1.0 : (b - a).cross(c - a).norm();
            until[i] = sum;
        }
        if (sum > 0.0)
            break;
    }
    Points samples;
    for (int k = 0; k < count; ++k) {
        const auto place = 3 * static_cast<std::uint64_t>(k);
        const double wanted = sum * (k + hash_uniform(seed, place)) / count;
        const auto found = std::upper_bound(until.begin(), until.end(), wanted);
        const auto i = std::min(static_cast<std::size_t>(found - until.begin()), order.size() - 1);
        const Tri& t = triangles[order[i]];
        // Uniform in the triangle (Osada et al. 2002): weights 1 - sqrt(p), sqrt(p) (1 - q), sqrt(p) q.
        const double root = std::sqrt(hash_uniform(seed, place + 1)), q = hash_uniform(seed, place + 2);
        samples.emplace_back((1.0 - root) * corner(positions, t, 0) +
                             root * (1.0 - q) * corner(positions, t, 1) + root * q * corner(positions, t, 2));
    }
    return samples;
}

} // namespace fascicle::chmd
