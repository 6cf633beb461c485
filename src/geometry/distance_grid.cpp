#include "fascicle/geometry/distance_grid.hpp"

#include "distance_splat.hpp"
#include "fascicle/base/assert.hpp"
#include "fascicle/base/parallel.hpp"
#include "fascicle/geometry/bounding_box.hpp"
#include "grid_sign.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>

namespace fascicle {

namespace {

constexpr const char* stage = "distance grid";
constexpr std::size_t large_chunk = std::size_t{1} << 18; // nodes, where the work per node is small

/// The largest float that is not above x.
float float_below(double x) {
    const auto f = static_cast<float>(x);
    return static_cast<double>(f) > x ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
}

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
    values_.resize(step_z_ * static_cast<std::size_t>(nodes_[2]));
}

void DistanceGrid::fill_distances(const TriMesh& mesh, int threads, const JobControl& control) {
    const GridShape shape{low_, spacing_, nodes_};
    parallel_for(threads, values_.size(), large_chunk, [&](std::size_t begin, std::size_t end) {
        std::fill(values_.data() + begin, values_.data() + end, std::numeric_limits<float>::infinity());
    });
    splat_squared_distances(
        shape, mesh.positions, mesh.triangles, saturation_, threads, control,
        [&](double share) { control.checkpoint(stage, 0.7 * share); }, values_.data());
}

void DistanceGrid::set_signs(const TriMesh& mesh, int threads, const JobControl& control) {
    const GridShape shape{low_, spacing_, nodes_};
    const GridSign sign(shape, mesh.positions, mesh.triangles, threads);
    control.checkpoint(stage, 0.8);
    const std::size_t rows = static_cast<std::size_t>(nodes_[1]) * static_cast<std::size_t>(nodes_[2]);
    const auto saturated = static_cast<float>(saturation_); // exact: it is made of a float
    parallel_for(threads, rows, 256, [&](std::size_t begin, std::size_t end) {
        if (control.cancelled())
            throw Cancelled();
        std::vector<unsigned char> inside(step_y_);
        for (std::size_t row = begin; row < end; ++row) {
            sign.mark_row(static_cast<int>(row) % nodes_[1], static_cast<int>(row) / nodes_[1], inside);
            float* values = values_.data() + row * step_y_;
            for (std::size_t i = 0; i < inside.size(); ++i) {
                const float squared = values[i]; // in units of the spacing
                const float distance =
                    squared == std::numeric_limits<float>::infinity()
                        ? saturated
                        : std::min(saturated,
                                   float_below(spacing_ * std::sqrt(static_cast<double>(squared))));
                values[i] = inside[i] != 0 ? -distance : distance;
            }
        }
    });
    control.checkpoint(stage, 0.9);
}

void DistanceGrid::make_conservative(const TriMesh& mesh, int threads, const JobControl& control) {
    const double step = spacing_ / 4.0;
    // -1: no surface sample in any cell of the node.
    LargeArray<float> lowering(values_.size());
    parallel_for(threads, lowering.size(), large_chunk, [&](std::size_t begin, std::size_t end) {
        std::fill(lowering.data() + begin, lowering.data() + end, -1.0f);
    });
    const std::array<std::size_t, 8> corners{0,       1,           step_y_,           step_y_ + 1,
                                             step_z_, step_z_ + 1, step_y_ + step_z_, step_y_ + step_z_ + 1};
    const auto at = [&](int v) -> const Vec3& { return mesh.positions[static_cast<std::size_t>(v)]; };
    parallel_for(threads, mesh.triangles.size(), 1024, [&](std::size_t begin, std::size_t end) {
        if (control.cancelled())
            throw Cancelled();
        for (std::size_t t = begin; t < end; ++t) {
            const Tri& tri = mesh.triangles[t];
            const Vec3 normal = (at(tri[1]) - at(tri[0])).cross(at(tri[2]) - at(tri[0])).normalized();
            // Samples of one cell mostly follow each other: its corners are raised once for all of them.
            constexpr std::size_t no_cell = std::numeric_limits<std::size_t>::max();
            std::size_t cell = no_cell;
            double cell_need = 0.0;
            Cell around{};
            const auto raise_corners = [&] {
                if (cell == no_cell)
                    return;
                const float need = -float_below(-cell_need);
                for (const std::size_t offset : corners)
                    raise_to(lowering[cell + offset], need);
            };
            sample_triangle(at(tri[0]), at(tri[1]), at(tri[2]), step, [&](const Vec3& p) {
                std::size_t corner = 0;
                if (!locate_corner(p, corner, around.share))
                    return;
                if (corner != cell) {
                    raise_corners();
                    load_corners(corner, around);
                    cell = corner;
                    cell_need = 0.0;
                }
                // Half a step along the surface at the rate at which the interpolant changes there.
                const DistanceSample phi = interpolate(around);
                const Vec3 along = phi.gradient - phi.gradient.dot(normal) * normal;
                const double rise = 0.5 * step;
                const double squared = along.squaredNorm();
                // The root only where it can matter.
                if (const double missing = cell_need - phi.value;
                    missing < 0.0 || rise * rise * squared > missing * missing)
                    cell_need = std::max(cell_need, phi.value + rise * std::sqrt(squared));
            });
            raise_corners();
        }
    });
    struct Part {
        double sum = 0, largest = 0;
        std::size_t count = 0;
    };
    std::vector<Part> parts((values_.size() + large_chunk - 1) / large_chunk);
    parallel_for(threads, values_.size(), large_chunk, [&](std::size_t begin, std::size_t end) {
        Part part;
        for (std::size_t i = begin; i < end; ++i) {
            const auto c = static_cast<double>(lowering[i]);
            if (c < 0.0)
                continue;
            values_[i] = float_below(static_cast<double>(values_[i]) - c);
            part.largest = std::max(part.largest, c);
            part.sum += c;
            ++part.count;
        }
        parts[begin / large_chunk] = part;
    });
    Part total;
    for (const Part& part : parts) {
        total.largest = std::max(total.largest, part.largest);
        total.sum += part.sum;
        total.count += part.count;
    }
    correction_max_ = total.largest;
    correction_mean_ = total.count > 0 ? total.sum / static_cast<double>(total.count) : 0.0;
}

} // namespace fascicle
