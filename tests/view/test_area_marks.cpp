#include "view/area_marks.hpp"

#include "support/shapes.hpp"
#include "view/attachment_marks.hpp"
#include "view/colour_map.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace fascicle;
using namespace fascicle::view;

namespace {

const render::Rgba base = palette::bone;

ShownArea area_of(const TriMesh& mesh, AttachmentKind kind, const std::vector<int>& vertices,
                  bool faint = false) {
    return {0, {kind, 0, "", SurfaceRegion(mesh.vertex_count(), vertices)}, faint};
}

std::vector<int> square(int n, int low, int high) {
    std::vector<int> vertices;
    for (int j = low; j <= high; ++j)
        for (int i = low; i <= high; ++i)
            vertices.push_back(j * (n + 1) + i);
    return vertices;
}

double length(const AreaMarks& marks) {
    double sum = 0;
    const auto& points = *marks.border_points();
    for (std::size_t i = 0; i + 1 < points.size(); i += 2)
        sum += Vec3(points[i + 1][0] - points[i][0], points[i + 1][1] - points[i][1],
                    points[i + 1][2] - points[i][2])
                   .norm();
    return sum;
}

} // namespace

TEST_CASE("Following areas step by step gives the same colours and borders as making them at once",
          "[view][area_marks]") {
    const auto mesh = std::make_shared<const TriMesh>(test::sphere(10, 4));
    AreaMarks followed(mesh);
    std::mt19937 random(7);
    std::vector<int> origin, insertion;
    for (int step = 0; step < 30; ++step) {
        const int centre = static_cast<int>(random() % unsigned(mesh->vertex_count()));
        std::vector<int>& grown = step % 3 == 0 ? origin : insertion;
        if (step % 7 == 6)
            grown.clear();
        std::vector<int> lit;
        for (int v = 0; v < mesh->vertex_count(); ++v) {
            const double d = (mesh->positions[std::size_t(v)] - mesh->positions[std::size_t(centre)]).norm();
            if (d < 3)
                grown.push_back(v);
            if (d < 4)
                lit.push_back(v);
        }
        std::vector<ShownArea> areas;
        if (!origin.empty())
            areas.push_back(area_of(*mesh, AttachmentKind::origin, origin, step % 5 == 0));
        areas.push_back(area_of(*mesh, AttachmentKind::insertion, insertion));
        const std::vector<BoneHighlight> highlights{{0, lit, {1, 1, 0, step < 15 ? 0.5f : 0.3f}}};
        followed.update(0, areas, highlights, base);
        AreaMarks fresh(mesh);
        fresh.update(0, areas, highlights, base);
        CHECK(followed.colours()->colours == fresh.colours()->colours);
        CHECK(length(followed) == Approx(length(fresh)).epsilon(0.1)); // dashes may begin elsewhere
    }
}

TEST_CASE("A small change is a small range of the colours", "[view][area_marks]") {
    const auto mesh = std::make_shared<const TriMesh>(test::sheet(200, 200));
    AreaMarks marks(mesh);
    marks.update(0, {area_of(*mesh, AttachmentKind::origin, square(200, 50, 60))}, {}, base);
    const auto before = marks.colours();
    const std::uint64_t revision = before->revision;
    marks.update(0, {area_of(*mesh, AttachmentKind::origin, square(200, 50, 61))}, {}, base);
    CHECK(marks.colours() == before); // the same array
    CHECK(marks.colours()->revision == revision + 1);
    std::size_t sent = 0;
    for (const render::LiveColours::Change& change : marks.colours()->changes)
        sent += change.count;
    CHECK(sent >= 23);
    CHECK(sent < 200);
    marks.update(0, {area_of(*mesh, AttachmentKind::origin, square(200, 50, 61))}, {}, base);
    CHECK(marks.colours()->revision == revision + 1);
    marks.update(0, {}, {}, base);
    CHECK(marks.colours() == nullptr);
    CHECK(marks.border_points()->empty());
}

TEST_CASE("Origins are bordered by solid lines, insertions by dashes", "[view][area_marks]") {
    const auto mesh = std::make_shared<const TriMesh>(test::sheet(60, 60));
    AreaMarks solid(mesh), dashed(mesh), faint(mesh);
    solid.update(0, {area_of(*mesh, AttachmentKind::origin, square(60, 20, 40))}, {}, base);
    dashed.update(0, {area_of(*mesh, AttachmentKind::insertion, square(60, 20, 40))}, {}, base);
    CHECK(length(solid) == Approx(84).epsilon(0.04)); // through the middles of edges: 4 x 21 less the corners
    CHECK(length(dashed) / length(solid) == Approx(0.6).margin(0.05));
    const int inside = 30 * 61 + 30;
    CHECK(solid.colours()->colours[inside] != dashed.colours()->colours[inside]);
    faint.update(0, {area_of(*mesh, AttachmentKind::origin, square(60, 20, 40), true)}, {}, base);
    CHECK(faint.colours()->colours[inside] != solid.colours()->colours[inside]);
    CHECK(solid.colours()->colours[0] == base);
}

TEST_CASE("An area made for another mesh, or of another bone, is not shown", "[view][area_marks]") {
    const auto mesh = std::make_shared<const TriMesh>(test::sheet(4, 4));
    AreaMarks marks(mesh);
    ShownArea other = area_of(*mesh, AttachmentKind::origin, {1, 2});
    other.area.bone = 3;
    ShownArea unlike{0, {AttachmentKind::origin, 0, "", SurfaceRegion(7)}, false};
    marks.update(0, {other, unlike}, {{0, {-1, 900}, {}}}, base);
    CHECK_FALSE(marks.any());
}
