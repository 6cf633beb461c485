#include "editor/initial_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace fascicle::editor {

namespace {

constexpr int cells = 72;      ///< of a side of the raster
constexpr int directions = 24; ///< tried around the scene
constexpr double pitch = 0.21; ///< radians above the horizon
constexpr double front_left = 0.61;

/// Points of surfaces dropped into a raster seen along the camera: the nearest one takes the cell. Coarse, but cheap.
struct Raster {
    struct Cell {
        double depth = -std::numeric_limits<double>::infinity(); ///< larger is nearer
        int muscle = -1;
    };
    std::vector<Cell> grid = std::vector<Cell>(std::size_t(cells) * cells);
    Vec3 right, up, towards, centre;
    double half; ///< scene units from the middle to the border

    void add(const Vec3& p, int muscle) {
        const Vec3 d = p - centre;
        const auto place = [&](double x) { return static_cast<int>((x / half * 0.5 + 0.5) * cells); };
        const int x = place(d.dot(right)), y = place(d.dot(up));
        if (x < 0 || y < 0 || x >= cells || y >= cells)
            return;
        Cell& cell = grid[std::size_t(y) * cells + std::size_t(x)];
        const double depth = d.dot(towards);
        if (depth > cell.depth)
            cell = {depth, muscle};
    }

    /// Corners of its triangles, and points in between where they are farther apart than cells.
    void add(const TriMesh& mesh, int muscle) {
        for (const Vec3& p : mesh.positions)
            add(p, muscle);
        const double cell = 2 * half / cells;
        for (const Tri& t : mesh.triangles) {
            const auto at = [&](std::size_t k) -> const Vec3& {
                return mesh.positions[static_cast<std::size_t>(t[k])];
            };
            const Vec3 a = at(0), ab = at(1) - a, ac = at(2) - a;
            const double longest = std::max({ab.norm(), ac.norm(), (ab - ac).norm()});
            const int steps = static_cast<int>(std::min(longest / cell, 4.0 * cells)); // more lie outside
            for (int i = 0; i <= steps && steps > 1; ++i)
                for (int j = 0; j <= steps - i; ++j)
                    add(a + ab * i / steps + ac * j / steps, muscle);
        }
    }
};

/// Square roots, so that a little of two muscles is better than much of one.
double score(const view::Camera& camera, const Scene& scene, const BoundingBox& box) {
    Raster raster;
    raster.right = camera.right();
    raster.up = camera.up();
    raster.towards = camera.backward();
    raster.centre = box.center();
    raster.half = box.diagonal() / 2;
    for (const Bone& bone : scene.bones)
        raster.add(*bone.mesh, -1);
    for (std::size_t m = 0; m < scene.muscles.size(); ++m)
        raster.add(*scene.muscles[m].mesh, static_cast<int>(m));
    std::vector<double> seen(scene.muscles.size(), 0);
    for (const Raster::Cell& cell : raster.grid)
        if (cell.muscle >= 0)
            seen[static_cast<std::size_t>(cell.muscle)] += 1;
    double sum = 0;
    for (const double count : seen)
        sum += std::sqrt(count);
    return sum;
}

} // namespace

void look_at_muscles(view::Camera& camera, const Scene& scene) {
    view::Camera start(camera.axes());
    start.orbit_by(0, pitch);
    BoundingBox box;
    for (const Muscle& muscle : scene.muscles)
        box.add(bounding_box(muscle.mesh->positions));
    double best = -1, best_yaw = front_left;
    for (int i = 0; i < directions && box.diagonal() > 0; ++i) {
        const double yaw = front_left + 2 * std::numbers::pi * i / directions;
        view::Camera candidate = start;
        candidate.orbit_by(yaw, 0);
        const double value = score(candidate, scene, box);
        if (value > best * 1.02) { // a hair better is no reason to look from somewhere unusual
            best = value;
            best_yaw = yaw;
        }
    }
    camera.look_from(view::StandardView::anterior);
    camera.orbit_by(best_yaw, pitch);
}

} // namespace fascicle::editor
