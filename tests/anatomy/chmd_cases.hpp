#pragma once
// Fibre problems whose answers are known, for tests of CHMD.

#include "fascicle/anatomy/fibre_problem.hpp"
#include "fascicle/geometry/primitives.hpp"
#include "support/shapes.hpp"

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

namespace fascicle::test {

/// A problem that owns what it points to.
struct ChmdCase {
    TriMesh mesh;
    MeshTopology topology;
    Polylines fibres;
    std::vector<AttachmentPatch> patches;

    void add_fibre(const Points& points) {
        std::vector<int> line;
        for (const Vec3& p : points) {
            line.push_back(static_cast<int>(fibres.points.size()));
            fibres.points.push_back(p);
        }
        fibres.lines.push_back(line);
    }
    void add_patch(AttachmentKind kind, const std::function<bool(const Vec3&)>& takes) {
        AttachmentPatch patch{kind, {}, {}, std::string(to_text(kind)) + " on block"};
        for (int v = 0; v < mesh.vertex_count(); ++v)
            if (takes(mesh.positions[static_cast<std::size_t>(v)]))
                patch.vertices.push_back(v);
        patches.push_back(patch);
    }
    FibreProblem problem(int count, int segments, int threads = 1) {
        topology = MeshTopology(mesh.vertex_count(), mesh.triangles);
        FibreProblem p;
        p.muscle = "strap";
        p.surface = &mesh;
        p.topology = &topology;
        p.patches = patches;
        p.count = count;
        p.segments = segments;
        p.surface_fibres = &fibres;
        p.threads = threads;
        return p;
    }
};

/// Box 60 x 20 x 100 with its ends attached (origin above) and three straight fibres on its front (y = 0), given in a
/// muddle of order and direction.
inline ChmdCase box_case() {
    ChmdCase made;
    made.mesh = box_mesh(Vec3(0, 0, 0), Vec3(60, 20, 100), {12, 4, 20});
    made.add_patch(AttachmentKind::origin, [](const Vec3& p) { return p.z() > 99.9; });
    made.add_patch(AttachmentKind::insertion, [](const Vec3& p) { return p.z() < 0.1; });
    made.add_fibre({Vec3(30, 0, 95), Vec3(30, 0, 50), Vec3(30, 0, 5)});
    made.add_fibre({Vec3(50, 0, 5), Vec3(50, 0, 60), Vec3(50, 0, 95)});
    made.add_fibre({Vec3(10, 0, 95), Vec3(10, 0, 5)});
    return made;
}

inline const Vec3 ellipsoid_radii(30, 15, 60);

/// Ellipsoid with its poles attached and five meridians on its front.
inline ChmdCase ellipsoid_case(int levels = 4) {
    ChmdCase made;
    made.mesh = sphere(1.0, levels);
    for (Vec3& p : made.mesh.positions)
        p = p.cwiseProduct(ellipsoid_radii);
    made.add_patch(AttachmentKind::origin, [](const Vec3& p) { return p.z() > 55; });
    made.add_patch(AttachmentKind::insertion, [](const Vec3& p) { return p.z() < -55; });
    for (const double longitude : {-0.9, -0.45, 0.0, 0.45, 0.9}) {
        Points line;
        for (int k = 0; k <= 12; ++k) {
            const double latitude = 1.2 - 0.2 * k;
            line.push_back(Vec3(std::cos(latitude) * std::sin(longitude),
                                -std::cos(latitude) * std::cos(longitude), std::sin(latitude))
                               .cwiseProduct(ellipsoid_radii));
        }
        made.add_fibre(line);
    }
    return made;
}

/// Two bars beside each other, 20 wide, 20 apart, 10 deep, 80 high; the fibres run in their middles.
inline ChmdCase two_bars_case() {
    ChmdCase made;
    made.mesh = joined(box_mesh(Vec3(0, 0, 0), Vec3(20, 10, 80), {4, 2, 16}),
                       box_mesh(Vec3(40, 0, 0), Vec3(60, 10, 80), {4, 2, 16}));
    made.add_patch(AttachmentKind::origin, [](const Vec3& p) { return p.z() > 79.9 && p.x() < 30; });
    made.add_patch(AttachmentKind::origin, [](const Vec3& p) { return p.z() > 79.9 && p.x() > 30; });
    made.add_patch(AttachmentKind::insertion, [](const Vec3& p) { return p.z() < 0.1; });
    made.add_fibre({Vec3(10, 0, 75), Vec3(10, 0, 5)});
    made.add_fibre({Vec3(50, 0, 75), Vec3(50, 0, 5)});
    return made;
}

} // namespace fascicle::test
