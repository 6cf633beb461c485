#include "solver/rivals/tet_overlap.hpp"

#include <algorithm>
#include <limits>

namespace fascicle::solver {

namespace {

struct Span {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    void add(double x) {
        low = std::min(low, x);
        high = std::max(high, x);
    }
};

/// size: of the tetrahedron, for what counts as touching.
bool parts(const Vec3& axis, const std::array<Vec3, 3>& triangle, const TetCorners& tet, double size) {
    const double length = axis.norm();
    if (!(length > 1e-12 * size * size)) // of two parallel edges: other axes tell
        return false;
    Span a, b;
    for (const Vec3& p : triangle)
        a.add(axis.dot(p));
    for (const Vec3& p : tet)
        b.add(axis.dot(p));
    const double slack = 1e-12 * size * length;
    return a.high < b.low - slack || b.high < a.low - slack;
}

} // namespace

bool triangle_meets_tet(const std::array<Vec3, 3>& triangle, const TetCorners& tet) {
    // About the tetrahedron, so that a surface far from the origin loses no digits.
    std::array<Vec3, 3> t = triangle;
    TetCorners x = tet;
    for (Vec3& p : t)
        p -= tet[0];
    for (Vec3& p : x)
        p -= tet[0];
    const double size = std::max({x[1].norm(), x[2].norm(), x[3].norm()});
    std::array<Vec3, 3> sides;
    for (std::size_t i = 0; i < 3; ++i)
        sides[i] = t[(i + 1) % 3] - t[i];
    constexpr std::array<std::array<std::size_t, 2>, 6> edges{
        {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
    constexpr std::array<std::array<std::size_t, 3>, 4> faces{{{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}};
    for (const auto& [a, b, c] : faces)
        if (parts((x[b] - x[a]).cross(x[c] - x[a]), t, x, size))
            return false;
    if (parts(sides[0].cross(sides[1]), t, x, size))
        return false;
    for (const auto& [a, b] : edges)
        for (const Vec3& side : sides)
            if (parts(side.cross(x[b] - x[a]), t, x, size))
                return false;
    return true;
}

std::array<double, 4> tet_weights(const Vec3& p, const TetCorners& tet) {
    Mat3 m;
    m << tet[1] - tet[0], tet[2] - tet[0], tet[3] - tet[0];
    const double volume = m.determinant();
    const Vec3 q = p - tet[0];
    const double w1 = q.dot(m.col(1).cross(m.col(2))) / volume;
    const double w2 = q.dot(m.col(2).cross(m.col(0))) / volume;
    const double w3 = q.dot(m.col(0).cross(m.col(1))) / volume;
    return {1.0 - w1 - w2 - w3, w1, w2, w3};
}

} // namespace fascicle::solver
