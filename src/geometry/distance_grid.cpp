#include "fascicle/geometry/distance_grid.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/parallel.hpp"
#include "fascicle/geometry/bounding_box.hpp"
#include "fascicle/geometry/bvh.hpp"
#include "grid_sign.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>

namespace fascicle {

namespace {

constexpr const char* stage = "distance grid";
constexpr int block_size = 8; // nodes a side; whole blocks far from the surface are settled by one query
constexpr int part_size = 4;

/// The largest float that is not above x.
float float_below(double x) {
    const auto f = static_cast<float>(x);
    return static_cast<double>(f) > x ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
}

/// Unsigned, saturated distances of the nodes of a block; nodes left alone keep the saturation.
class BlockFill {
public:
    BlockFill(const GridShape& shape, const TriangleBvh& bvh, double saturation, std::vector<float>& values)
        : shape_(shape), bvh_(bvh), saturation_(saturation), values_(values) {}

    void fill(const std::array<int, 3>& low, int size) {
        std::array<int, 3> high{};
        for (std::size_t k = 0; k < 3; ++k)
            high[k] = std::min(low[k] + size, shape_.nodes[k]);
        const Vec3 first = shape_.node(low[0], low[1], low[2]);
        const Vec3 last = shape_.node(high[0] - 1, high[1] - 1, high[2] - 1);
        const double half = 0.5 * (last - first).norm();
        const double reach = (saturation_ + half) * (1.0 + 1e-9);
        if (bvh_.closest_squared_distance(0.5 * (first + last), reach, hint_) >= reach * reach)
            return;
        if (size == part_size) {
            fill_nodes(low, high);
            return;
        }
        for (int k = low[2]; k < high[2]; k += part_size)
            for (int j = low[1]; j < high[1]; j += part_size)
                for (int i = low[0]; i < high[0]; i += part_size)
                    fill({i, j, k}, part_size);
    }

private:
    void fill_nodes(const std::array<int, 3>& low, const std::array<int, 3>& high) {
        bool backwards = false; // to and fro, so that consecutive nodes are neighbours
        for (int k = low[2]; k < high[2]; ++k)
            for (int j = low[1]; j < high[1]; ++j, backwards = !backwards)
                for (int step = low[0]; step < high[0]; ++step) {
                    const int i = backwards ? low[0] + high[0] - 1 - step : step;
                    const double d2 = bvh_.closest_squared_distance(shape_.node(i, j, k), saturation_, hint_);
                    values_[shape_.row(j, k) + static_cast<std::size_t>(i)] = float_below(std::sqrt(d2));
                }
    }

    const GridShape& shape_;
    const TriangleBvh& bvh_;
    double saturation_;
    std::vector<float>& values_;
    int hint_ = -1;
};

/// Calls visit(point) for points of the triangle, corners included, no gap wider than `step` along or across.
template <typename Visit>
void sample_triangle(Vec3 a, Vec3 b, Vec3 c, double step, const Visit& visit) {
    // Rows parallel to the longest side ab, from there to c: slivers get few points.
    double ab = (b - a).norm();
    for (int turn = 0; turn < 2; ++turn)
        if (const double bc = (c - b).norm(), ca = (a - c).norm(); ab < std::max(bc, ca)) {
            const Vec3 old_a = a;
            a = b;
            b = c;
            c = old_a;
            ab = bc;
        }
    const Vec3 side = b - a;
    const double along = ab > 0.0 ? std::clamp((c - a).dot(side) / (ab * ab), 0.0, 1.0) : 0.0;
    const double height = (a + along * side - c).norm();
    const int rows = static_cast<int>(std::ceil(height / step));
    for (int r = 0; r <= rows; ++r) {
        const double t = rows > 0 ? static_cast<double>(r) / rows : 0.0;
        const Vec3 from = a + t * (c - a), to = b + t * (c - b);
        const int count = static_cast<int>(std::ceil((1.0 - t) * ab / step));
        for (int i = 0; i <= count; ++i)
            visit(count > 0 ? Vec3(from + (static_cast<double>(i) / count) * (to - from)) : from);
    }
}

void raise_to(float& place, float value) {
    std::atomic_ref<float> cell(place);
    float old = cell.load(std::memory_order_relaxed);
    while (old < value && !cell.compare_exchange_weak(old, value, std::memory_order_relaxed)) {
    }
}

} // namespace

DistanceGrid::DistanceGrid(const TriMesh& mesh, const DistanceGridOptions& options,
                           const JobControl& control) {
    FASCICLE_ASSERT(options.spacing > 0.0 && options.saturation > 0.0 && options.max_nodes >= 8);
    saturation_ = static_cast<double>(float_below(options.saturation));
    spacing_ = options.spacing;
    if (mesh.triangles.empty())
        return;
    control.checkpoint(stage, 0.0);
    choose_shape(mesh, options);
    fill_distances(mesh, options.threads, control);
    set_signs(mesh, options.threads, control);
    make_conservative(mesh, options.threads, control);
    control.checkpoint(stage, 1.0);
}

void DistanceGrid::choose_shape(const TriMesh& mesh, const DistanceGridOptions& options) {
    const BoundingBox box = bounding_box(mesh.positions, mesh.triangles);
    low_ = box.min - Vec3::Constant(saturation_);
    const Vec3 size = box.size() + Vec3::Constant(2.0 * saturation_);
    FASCICLE_ASSERT(size.allFinite());
    const auto count = [&] {
        Vec3 n;
        for (Eigen::Index k = 0; k < 3; ++k)
            n[k] = std::floor(size[k] / spacing_) + 2.0;
        return n;
    };
    Vec3 n = count();
    while (n.prod() > static_cast<double>(options.max_nodes) && n.maxCoeff() > 2.0) {
        spacing_ *= std::max(1.001, std::cbrt(n.prod() / static_cast<double>(options.max_nodes)) * 0.999);
        n = count();
    }
    per_spacing_ = 1.0 / spacing_;
    for (std::size_t k = 0; k < 3; ++k)
        nodes_[k] = static_cast<int>(n[static_cast<Eigen::Index>(k)]);
    step_y_ = static_cast<std::size_t>(nodes_[0]);
    step_z_ = step_y_ * static_cast<std::size_t>(nodes_[1]);
    values_.assign(step_z_ * static_cast<std::size_t>(nodes_[2]), float_below(saturation_));
}

void DistanceGrid::fill_distances(const TriMesh& mesh, int threads, const JobControl& control) {
    const GridShape shape{low_, spacing_, nodes_};
    const TriangleBvh bvh(mesh);
    const auto blocks = [&](std::size_t axis) {
        return static_cast<std::size_t>((nodes_[axis] + block_size - 1) / block_size);
    };
    const std::size_t slabs = blocks(2), columns = blocks(0) * blocks(1);
    for (std::size_t slab = 0; slab < slabs; ++slab) {
        parallel_for(threads, columns, 8, [&](std::size_t begin, std::size_t end) {
            if (control.cancelled())
                throw Cancelled();
            BlockFill block(shape, bvh, saturation_, values_);
            for (std::size_t c = begin; c < end; ++c)
                block.fill({block_size * static_cast<int>(c % blocks(0)),
                            block_size * static_cast<int>(c / blocks(0)),
                            block_size * static_cast<int>(slab)},
                           block_size);
        });
        control.checkpoint(stage, 0.8 * static_cast<double>(slab + 1) / static_cast<double>(slabs));
    }
}

void DistanceGrid::set_signs(const TriMesh& mesh, int threads, const JobControl& control) {
    const GridShape shape{low_, spacing_, nodes_};
    const GridSign sign(shape, mesh.positions, mesh.triangles);
    control.checkpoint(stage, 0.85);
    const std::size_t rows = static_cast<std::size_t>(nodes_[1]) * static_cast<std::size_t>(nodes_[2]);
    parallel_for(threads, rows, 256, [&](std::size_t begin, std::size_t end) {
        if (control.cancelled())
            throw Cancelled();
        std::vector<unsigned char> inside(step_y_);
        for (std::size_t row = begin; row < end; ++row) {
            sign.mark_row(static_cast<int>(row) % nodes_[1], static_cast<int>(row) / nodes_[1], inside);
            float* values = values_.data() + row * step_y_;
            for (std::size_t i = 0; i < inside.size(); ++i)
                values[i] = inside[i] != 0 ? -values[i] : values[i];
        }
    });
    control.checkpoint(stage, 0.9);
}

void DistanceGrid::make_conservative(const TriMesh& mesh, int threads, const JobControl& control) {
    const double step = spacing_ / 4.0;
    // -1: no surface sample in any cell of the node.
    std::vector<float> lowering(values_.size(), -1.0f);
    const std::array<std::size_t, 8> corners{0,       1,           step_y_,           step_y_ + 1,
                                             step_z_, step_z_ + 1, step_y_ + step_z_, step_y_ + step_z_ + 1};
    const auto at = [&](int v) -> const Vec3& { return mesh.positions[static_cast<std::size_t>(v)]; };
    parallel_for(threads, mesh.triangles.size(), 1024, [&](std::size_t begin, std::size_t end) {
        if (control.cancelled())
            throw Cancelled();
        for (std::size_t t = begin; t < end; ++t) {
            const Tri& tri = mesh.triangles[t];
            const Vec3 normal = (at(tri[1]) - at(tri[0])).cross(at(tri[2]) - at(tri[0])).normalized();
            sample_triangle(at(tri[0]), at(tri[1]), at(tri[2]), step, [&](const Vec3& p) {
                std::size_t corner = 0;
                std::array<double, 3> share{};
                if (!locate_corner(p, corner, share))
                    return;
                // Half a step along the surface at the rate at which the interpolant changes there.
                const DistanceSample phi = sample(p);
                const Vec3 along = phi.gradient - phi.gradient.dot(normal) * normal;
                const double highest = phi.value + 0.5 * step * along.norm();
                const float need = -float_below(-std::max(highest, 0.0));
                for (const std::size_t offset : corners)
                    raise_to(lowering[corner + offset], need);
            });
        }
    });
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < values_.size(); ++i) {
        const auto c = static_cast<double>(lowering[i]);
        if (c < 0.0)
            continue;
        values_[i] = float_below(static_cast<double>(values_[i]) - c);
        correction_max_ = std::max(correction_max_, c);
        sum += c;
        ++count;
    }
    correction_mean_ = count > 0 ? sum / static_cast<double>(count) : 0.0;
}

} // namespace fascicle
