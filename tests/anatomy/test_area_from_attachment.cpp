#include "fascicle/anatomy/area_from_attachment.hpp"
#include "fascicle/geometry/region_measure.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;

namespace {

/// A flat grid of n x n squares of side `step` at height z, facing up.
TriMesh sheet(int n, double step, double z) {
    TriMesh mesh;
    for (int y = 0; y <= n; ++y)
        for (int x = 0; x <= n; ++x)
            mesh.positions.emplace_back(x * step, y * step, z);
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const int a = y * (n + 1) + x;
            mesh.triangles.push_back({a, a + 1, a + n + 1});
            mesh.triangles.push_back({a + 1, a + n + 2, a + n + 1});
        }
    return mesh;
}

} // namespace

TEST_CASE("The area under an attachment is the part of the bone that its triangles lie on",
          "[anatomy][area]") {
    const SurfaceGraph bone(std::make_shared<const TriMesh>(sheet(20, 1.0, 0)));
    const TriMesh muscle = sheet(20, 1.0, 0.5); // half a unit above
    Attachment attachment{AttachmentKind::insertion, 0, {}};
    for (int v = 0; v < muscle.vertex_count(); ++v)
        if (muscle.positions[static_cast<std::size_t>(v)].x() < 10.5 &&
            muscle.positions[static_cast<std::size_t>(v)].y() < 10.5)
            attachment.vertices.push_back(v);
    const SurfaceRegion area = area_from_attachment(bone, muscle, attachment, 0.6);
    // Exactly under it, and the ring within reach: sqrt(0.6^2 - 0.5^2) = 0.33 reaches no further vertex.
    CHECK(area == SurfaceRegion(bone.vertex_count(), attachment.vertices));
    CHECK(measure_region(bone, area).islands == 1);
    CHECK(area_from_attachment(bone, muscle, attachment, 0.4).empty());
    attachment.vertices = {0, 40, 80}; // no triangle among them
    CHECK(area_from_attachment(bone, muscle, attachment, 0.6).empty());
}
