#include "fascicle/geometry/implicit_field.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/base/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle {

namespace {
constexpr int root_size = 32; // nodes along the side of the blocks that are shared out to threads
constexpr int leaf_size = 4;
} // namespace

ImplicitField::ImplicitField(const Implicit& f, const FieldBox& box, int threads)
    : lower_(box.lower), spacing_(box.spacing), nodes_{} {
    FASCICLE_ASSERT(box.spacing > 0.0 && (box.upper - box.lower).minCoeff() > 0.0 && box.lipschitz >= 1.0);
    double count = 1.0;
    for (int a = 0; a < 3; ++a)
        count *= std::ceil((box.upper - box.lower)[a] / spacing_) + 1.0;
    if (!(count <= 134217728.0))
        throw_error("implicit field", "the grid would have too many nodes", "at most 2^27; a larger spacing");
    for (int a = 0; a < 3; ++a)
        nodes_[static_cast<std::size_t>(a)] =
            static_cast<int>(std::ceil((box.upper - box.lower)[a] / spacing_)) + 1;
    values_.assign(static_cast<std::size_t>(count), 0.0F);

    const auto blocks = [&](std::size_t a) { return (nodes_[a] + root_size - 1) / root_size; };
    const int bx = blocks(0), by = blocks(1), bz = blocks(2);
    parallel_for(threads, static_cast<std::size_t>(bx * by * bz), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t b = begin; b < end; ++b) {
            const int n = static_cast<int>(b);
            fill(f, box.lipschitz, {n % bx * root_size, n / bx % by * root_size, n / (bx * by) * root_size},
                 root_size);
        }
    });
    const auto is_border = [&](int n, std::size_t a) { return n == 0 || n == nodes_[a] - 1; };
    for (int k = 0; k < nodes_[2]; ++k)
        for (int j = 0; j < nodes_[1]; ++j) {
            const int step = is_border(k, 2) || is_border(j, 1) ? 1 : nodes_[0] - 1;
            for (int i = 0; i < nodes_[0]; i += step) {
                float& v = values_[index(i, j, k)];
                v = std::max(v, static_cast<float>(0.1 * spacing_));
            }
        }
}

void ImplicitField::fill(const Implicit& f, double lipschitz, const std::array<int, 3>& from, int size) {
    std::array<int, 3> to{};
    for (std::size_t a = 0; a < 3; ++a) {
        to[a] = std::min(from[a] + size, nodes_[a]);
        if (to[a] <= from[a])
            return;
    }
    const auto for_nodes = [&](const auto& set) {
        for (int k = from[2]; k < to[2]; ++k)
            for (int j = from[1]; j < to[1]; ++j)
                for (int i = from[0]; i < to[0]; ++i)
                    values_[index(i, j, k)] = static_cast<float>(set(i, j, k));
    };
    const Vec3 first = position(from[0], from[1], from[2]);
    const Vec3 last = position(to[0] - 1, to[1] - 1, to[2] - 1);
    const double radius = 0.5 * (last - first).norm();
    const double centre = f(0.5 * (first + last));
    if (std::abs(centre) > lipschitz * (radius + 2.0 * spacing_)) {
        for_nodes([&](int, int, int) { return centre; });
        return;
    }
    if (size <= leaf_size) {
        for_nodes([&](int i, int j, int k) { return f(position(i, j, k)); });
        return;
    }
    const int half = size / 2;
    for (int c = 0; c < 8; ++c)
        fill(f, lipschitz,
             {from[0] + (c & 1 ? half : 0), from[1] + (c & 2 ? half : 0), from[2] + (c & 4 ? half : 0)},
             half);
}

double ImplicitField::operator()(const Vec3& p) const {
    const Vec3 grid = (p - lower_) / spacing_;
    Vec3 held;
    std::array<int, 3> n{};
    for (int a = 0; a < 3; ++a) {
        held[a] = std::clamp(grid[a], 0.0, static_cast<double>(nodes_[static_cast<std::size_t>(a)] - 1));
        n[static_cast<std::size_t>(a)] =
            std::min(static_cast<int>(held[a]), nodes_[static_cast<std::size_t>(a)] - 2);
    }
    const Vec3 t = held - Vec3(n[0], n[1], n[2]);
    const std::size_t dx = 1, dy = static_cast<std::size_t>(nodes_[0]);
    const std::size_t dz = dy * static_cast<std::size_t>(nodes_[1]);
    const float* v = &values_[index(n[0], n[1], n[2])];
    const auto along_x = [&](std::size_t o) {
        return static_cast<double>(v[o]) +
               t.x() * (static_cast<double>(v[o + dx]) - static_cast<double>(v[o]));
    };
    const double low = (1.0 - t.y()) * along_x(0) + t.y() * along_x(dy);
    const double high = (1.0 - t.y()) * along_x(dz) + t.y() * along_x(dz + dy);
    return (1.0 - t.z()) * low + t.z() * high + (grid - held).norm() * spacing_;
}

Vec3 ImplicitField::gradient(const Vec3& p) const {
    const double h = 0.5 * spacing_;
    Vec3 g;
    for (int a = 0; a < 3; ++a) {
        const Vec3 d = h * Vec3::Unit(a);
        g[a] = ((*this)(p + d) - (*this)(p - d)) / (2.0 * h);
    }
    return g;
}

} // namespace fascicle
