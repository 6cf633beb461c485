#include "support/shapes.hpp"
#include "view/attachment_marks.hpp"
#include "view/vertex_extension.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::test;
using namespace fascicle::view;

TEST_CASE("Kinds per vertex follow the lists", "[view][attachment_marks]") {
    const auto kinds =
        vertex_kinds(5, {{AttachmentKind::origin, 0, {0, 1, 99}}, {AttachmentKind::insertion, 1, {1, 3}}});
    REQUIRE(kinds.size() == 5);
    CHECK(kinds[0] == AttachmentKind::origin);
    CHECK(kinds[1] == AttachmentKind::insertion);
    CHECK_FALSE(kinds[2]);
    CHECK(kinds[3] == AttachmentKind::insertion);
}

TEST_CASE("The border runs round an area once", "[view][attachment_marks]") {
    const TriMesh mesh = sheet(6, 6);
    // The vertices with x <= 2: the border is the line x = 2.5 across 6 quads, two triangles each.
    Attachment origin{AttachmentKind::origin, 0, {}};
    for (int i = 0; i < mesh.vertex_count(); ++i)
        if (mesh.positions[static_cast<std::size_t>(i)].x() < 2.5)
            origin.vertices.push_back(i);
    const auto segments = border_segments(mesh.triangles, vertex_kinds(mesh.vertex_count(), {origin}));
    CHECK(segments.size() == 12);
    double length = 0;
    for (const BorderSegment& s : segments) {
        const auto middle = [&](int a, int b) {
            return Vec3(0.5 * (mesh.positions[static_cast<std::size_t>(a)] +
                               mesh.positions[static_cast<std::size_t>(b)]));
        };
        const Vec3 a = middle(s.a0, s.a1), b = middle(s.b0, s.b1);
        CHECK(a.x() == Approx(2.5));
        CHECK(b.x() == Approx(2.5));
        CHECK(s.kind == AttachmentKind::origin);
        length += (b - a).norm();
    }
    CHECK(length == Approx(6.0));

    origin.kind = AttachmentKind::insertion; // every second one
    CHECK(border_segments(mesh.triangles, vertex_kinds(mesh.vertex_count(), {origin})).size() == 6);
    CHECK(border_segments(mesh.triangles, vertex_kinds(mesh.vertex_count(), {})).empty());
}

TEST_CASE("Vertex extension is the mean over the edges", "[view][vertex_extension]") {
    const TriMesh mesh = sheet(4, 3);
    const MeshTopology topology(mesh.vertex_count(), mesh.triangles);
    Points stretched = mesh.positions;
    for (Vec3& p : stretched)
        p *= 1.2;
    for (const double value : vertex_extension(topology, mesh.positions, stretched))
        CHECK(value == Approx(1.2));

    // Along x only: brute force over all triangles' edges, each counted once
    stretched = mesh.positions;
    for (Vec3& p : stretched)
        p.x() *= 1.5;
    const std::vector<double> values = vertex_extension(topology, mesh.positions, stretched);
    for (int i = 0; i < mesh.vertex_count(); ++i) {
        double sum = 0;
        int count = 0;
        for (int j = 0; j < mesh.vertex_count(); ++j) {
            bool joined = false;
            for (const Tri& t : mesh.triangles)
                joined = joined || (i != j && std::find(t.begin(), t.end(), i) != t.end() &&
                                    std::find(t.begin(), t.end(), j) != t.end());
            if (!joined)
                continue;
            const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
            sum += (stretched[a] - stretched[b]).norm() / (mesh.positions[a] - mesh.positions[b]).norm();
            ++count;
        }
        CHECK(values[static_cast<std::size_t>(i)] == Approx(sum / count));
    }
}

TEST_CASE("Vertices without usable edges count as unchanged", "[view][vertex_extension]") {
    const Points rest{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {7, 7, 7}, {3, 3, 3}, {3, 3, 3}, {3, 3, 3}};
    const MeshTopology topology(7, {{0, 1, 2}, {4, 5, 6}});
    const std::vector<double> values = vertex_extension(topology, rest, rest);
    CHECK(values == std::vector<double>(7, 1.0));
}
