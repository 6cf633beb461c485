#pragma once
// Muscles by formula with attachments, for the tests of fibres.

#include "fascicle/anatomy/fibre_problem.hpp"
#include "fascicle/geometry/primitives.hpp"

#include <cmath>

namespace fascicle::test {

/// A surface, its topology and a problem that points to both; copies point to their own.
struct FibreCase {
    explicit FibreCase(TriMesh surface) : mesh(std::move(surface)) {
        refresh();
        problem.muscle = "tube";
        problem.count = 20;
        problem.segments = 10;
    }
    FibreCase(const FibreCase& other) : mesh(other.mesh), problem(other.problem) { refresh(); }
    FibreCase& operator=(const FibreCase& other) {
        mesh = other.mesh;
        problem = other.problem;
        refresh();
        return *this;
    }

    /// After a change of the triangles.
    void refresh() {
        topology = MeshTopology(mesh.vertex_count(), mesh.triangles);
        problem.surface = &mesh;
        problem.topology = &topology;
    }
    template <typename Accept>
    void patch(AttachmentKind kind, const Accept& accept) {
        AttachmentPatch patch;
        patch.kind = kind;
        for (int v = 0; v < mesh.vertex_count(); ++v)
            if (accept(mesh.positions[static_cast<std::size_t>(v)]))
                patch.vertices.push_back(v);
        problem.patches.push_back(std::move(patch));
    }

    TriMesh mesh;
    MeshTopology topology;
    FibreProblem problem;
};

/// Radius 10 about z, from the origin's end at z = 0 to the insertion's at z = 100.
inline FibreCase tube_case() {
    FibreCase tube(cylinder_mesh(Vec3(0, 0, 0), Vec3(0, 0, 100), 10, 32, 24));
    tube.patch(AttachmentKind::origin, [](const Vec3& p) { return p.z() == 0; });
    tube.patch(AttachmentKind::insertion, [](const Vec3& p) { return p.z() == 100; });
    return tube;
}

/// 24 wide (y), 8 thick, bent by 120 degrees about the y axis over a length of 100: the middle line has radius 47.7.
inline FibreCase bent_case() {
    FibreCase muscle(box_mesh(Vec3(-4, -12, 0), Vec3(4, 12, 100), {4, 12, 40}));
    muscle.patch(AttachmentKind::origin, [](const Vec3& p) { return p.z() == 0; });
    muscle.patch(AttachmentKind::insertion, [](const Vec3& p) { return p.z() == 100; });
    const double bend = 2.0944, radius = 100 / bend;
    for (Vec3& p : muscle.mesh.positions) {
        const double angle = bend * p.z() / 100;
        p = Vec3((radius + p.x()) * std::cos(angle), p.y(), (radius + p.x()) * std::sin(angle));
    }
    return muscle;
}

} // namespace fascicle::test
