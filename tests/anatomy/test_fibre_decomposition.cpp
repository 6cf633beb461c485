#include "anatomy/fibres/contour_map.hpp"
#include "anatomy/fibres/fibre_field.hpp"
#include "fascicle/anatomy/fibre_methods.hpp"
#include "fascicle/geometry/closest_point.hpp"
#include "fascicle/geometry/primitives.hpp"
#include "fascicle/geometry/volume.hpp"
#include "fascicle/geometry/winding_number.hpp"
#include "support/fibre_cases.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace fascicle;
using test::FibreCase;

namespace {

std::string message_of(const FibreProblem& problem, const char* method) {
    for (const FibreMethod& row : fibre_methods())
        if (row.key == std::string(method))
            try {
                row.function(problem);
            } catch (const std::exception& error) {
                return error.what();
            }
    return "no error";
}

double distance_to_patch(const FibreProblem& problem, AttachmentKind kind, const Vec3& p) {
    double best = std::numeric_limits<double>::infinity();
    for (const Tri& t : attached_triangles(problem, kind)) {
        const auto at = [&](std::size_t k) {
            return problem.surface->positions[static_cast<std::size_t>(t[k])];
        };
        best = std::min(best, closest_point_on_triangle(p, at(0), at(1), at(2)).squared_distance);
    }
    return std::sqrt(best);
}

/// What holds for every method and muscle.
void check_model(const FibreModel& model, const FibreProblem& problem) {
    REQUIRE(model.rest.count == problem.count);
    REQUIRE(model.rest.segments == problem.segments);
    REQUIRE(model.rest.points.size() ==
            static_cast<std::size_t>(problem.count) * model.rest.points_per_fibre());
    REQUIRE(model.carrier.point_count() == model.rest.points.size());
    REQUIRE(model.field.size() == problem.surface->positions.size());
    for (const double u : model.field)
        REQUIRE((u >= 0.0 && u <= 1.0));
    const WindingNumber winding(*problem.surface);
    for (int f = 0; f < model.rest.count; ++f) {
        const auto fibre = model.rest.fibre(f);
        REQUIRE(distance_to_patch(problem, AttachmentKind::origin, fibre.front()) < 1e-9);
        REQUIRE(distance_to_patch(problem, AttachmentKind::insertion, fibre.back()) < 1e-9);
        for (std::size_t j = 1; j + 1 < fibre.size(); ++j)
            REQUIRE(winding.exact(fibre[j]) > 0.5);
    }
    Points points(model.rest.points.size());
    model.carrier.carry(problem.surface->positions, points);
    for (std::size_t i = 0; i < points.size(); ++i)
        REQUIRE((points[i] - model.rest.points[i]).norm() < 1e-6);
}

} // namespace

TEST_CASE("isolines: a cylinder's are circles that run clockwise about the gradient", "[anatomy][fibres]") {
    const TriMesh mesh = cylinder_mesh(Vec3(0, 0, 0), Vec3(0, 0, 10), 2, 24, 9);
    const MeshTopology topology(mesh.vertex_count(), mesh.triangles);
    std::vector<double> field;
    for (const Vec3& p : mesh.positions)
        field.push_back(p.z() / 10);
    IsolineFinder finder(mesh, topology, field);
    for (const double level : {0.2, 0.5, 0.55}) {
        const auto loops = finder.at(level);
        REQUIRE(loops.size() == 1);
        CHECK(loops[0].length == Approx(2 * 3.14159265 * 2).epsilon(0.01));
        Vec3 area = Vec3::Zero();
        for (std::size_t i = 0; i < loops[0].points.size(); ++i) {
            CHECK(loops[0].points[i].z() == Approx(10 * level));
            area += 0.5 * loops[0].points[i].cross(loops[0].points[(i + 1) % loops[0].points.size()]);
        }
        CHECK(area.z() < 0);
    }
    CHECK(finder.at(1.5).empty());
    CHECK(finder.at(-0.5).empty());
}

TEST_CASE("isolines: two loops where there are two, longest first, and open ones closed",
          "[anatomy][fibres]") {
    const TriMesh mesh = test::torus(3, 1, 60, 30);
    const MeshTopology topology(mesh.vertex_count(), mesh.triangles);
    std::vector<double> across, up;
    for (const Vec3& p : mesh.positions) {
        across.push_back(p.x());
        up.push_back(p.z());
    }
    CHECK(IsolineFinder(mesh, topology, across).at(0.123).size() == 2);
    const auto rings = IsolineFinder(mesh, topology, up).at(0.05);
    REQUIRE(rings.size() == 2);
    CHECK(rings[0].length > rings[1].length);
    CHECK(rings[0].length == Approx(2 * 3.14159265 * 4).epsilon(0.01));
    const TriMesh sheet = test::sheet(6, 4);
    std::vector<double> x;
    for (const Vec3& p : sheet.positions)
        x.push_back(p.x());
    const auto line = IsolineFinder(sheet, MeshTopology(sheet.vertex_count(), sheet.triangles), x).at(2.5);
    REQUIRE(line.size() == 1);
    CHECK(line[0].length == Approx(8)); // there and straight back
    const Points even = resampled_loop(rings[0], 50);
    for (std::size_t i = 0; i < even.size(); ++i)
        CHECK((even[(i + 1) % 50] - even[i]).norm() == Approx(rings[0].length / 50).epsilon(0.01));
}

TEST_CASE("outline cut: a circle on a sphere cuts out its cap exactly", "[anatomy][fibres]") {
    FibreCase sphere(test::sphere(10.0, 4));
    sphere.patch(AttachmentKind::origin, [](const Vec3& p) { return p.z() > 6.2; });
    sphere.patch(AttachmentKind::insertion, [](const Vec3& p) { return p.z() < -8; });
    for (int k = 0; k < 40; ++k)
        sphere.problem.patches[0].outline.emplace_back(8.2 * std::cos(k * 0.15708),
                                                       8.2 * std::sin(k * 0.15708), 6.1);
    const FibreField field = solve_fibre_field(sphere.problem);
    CHECK(field.notes.empty());
    const TriMesh& cut = field.surface.mesh;
    CHECK(cut.vertex_count() > sphere.mesh.vertex_count());
    CHECK(surface_area(cut.positions, cut.triangles) ==
          Approx(surface_area(sphere.mesh.positions, sphere.mesh.triangles)));
    CHECK(signed_volume(cut.positions, cut.triangles) ==
          Approx(signed_volume(sphere.mesh.positions, sphere.mesh.triangles)));
    CHECK(field.topology.boundary_edges().empty());
    CHECK(field.topology.inconsistent_edges().empty());
    CHECK(field.topology.nonmanifold_edges().empty());
    double area = 0;
    for (const Tri& t : cut.triangles)
        if (std::all_of(t.begin(), t.end(),
                        [&](int v) { return field.values[static_cast<std::size_t>(v)] == 0; })) {
            const auto at = [&](std::size_t k) { return cut.positions[static_cast<std::size_t>(t[k])]; };
            area += 0.5 * (at(1) - at(0)).cross(at(2) - at(0)).norm();
        }
    // The circle at z = 6.1 / sqrt(8.2^2 + 6.1^2) of the radius; a cap has the area 2 pi r h.
    const double height = 10 - 61 / std::hypot(8.2, 6.1);
    CHECK(area == Approx(2 * 3.14159265 * 10 * height).epsilon(0.01));
    for (std::size_t v = static_cast<std::size_t>(sphere.mesh.vertex_count()); v < cut.positions.size(); ++v)
        CHECK(cut.positions[v].z() == Approx(10 - height).margin(0.1));
}

TEST_CASE("outline cut: open lines and outlines elsewhere leave the attached vertices in charge",
          "[anatomy][fibres]") {
    FibreCase tube = test::tube_case();
    tube.problem.patches[0].outline = {Vec3(0, 0, 0), Vec3(9, 0, 0), Vec3(90, 0, 0)};
    CHECK(solve_fibre_field(tube.problem).notes.empty());
    tube.problem.patches[0].outline = {Vec3(300, 0, 0), Vec3(303, 0, 0), Vec3(300, 3, 0)};
    const FibreField far = solve_fibre_field(tube.problem);
    REQUIRE(far.notes.size() == 1);
    CHECK_THAT(far.notes[0], Catch::Contains("origin") && Catch::Contains("away from the muscle"));
    // One that cuts, with one that does not bound anything after it.
    for (const Vec3& p : {Vec3(6, 0, 0), Vec3(0, 6, 0), Vec3(-6, 0, 0), Vec3(0, -6, 0)})
        tube.problem.patches[1].outline.push_back(p + Vec3(0, 0, 100));
    tube.problem.patches[0].outline = {Vec3(9, 0, 1), Vec3(9.1, 0, 1), Vec3(9, 0.1, 1)};
    const FibreField second = solve_fibre_field(tube.problem);
    CHECK(second.notes.size() == 1);
    std::swap(tube.problem.patches[0], tube.problem.patches[1]);
    const FibreField first = solve_fibre_field(tube.problem);
    CHECK(first.notes.size() == 1);
    CHECK(first.surface.mesh.vertex_count() == second.surface.mesh.vertex_count());
    CHECK(first.surface.mesh.vertex_count() > tube.mesh.vertex_count());
    std::swap(tube.problem.patches[0], tube.problem.patches[1]);
    tube.problem.patches[1].outline.clear();
    // An outline around the other end.
    tube.problem.patches[0].outline = {Vec3(10, 0, 90), Vec3(0, 10, 90), Vec3(-10, 0, 90), Vec3(0, -10, 90)};
    const FibreField wrong = solve_fibre_field(tube.problem);
    REQUIRE(wrong.notes.size() == 1);
    CHECK(wrong.surface.mesh.vertex_count() == tube.mesh.vertex_count());
}

TEST_CASE("kukacka: parallel fibres of a straight tube are straight, equally long and cover it",
          "[anatomy][fibres]") {
    FibreCase tube = test::tube_case();
    tube.problem.count = 49;
    tube.problem.segments = 12;
    const FibreModel model = decompose_kukacka(tube.problem);
    check_model(model, tube.problem);
    CHECK(model.notes.empty());
    for (int f = 0; f < 49; ++f) {
        const auto fibre = model.rest.fibre(f);
        double length = 0;
        for (std::size_t j = 0; j + 1 < fibre.size(); ++j) {
            length += (fibre[j + 1] - fibre[j]).norm();
            CHECK((fibre[j] - fibre[0]).head<2>().norm() < 0.02);
            CHECK(fibre[j].z() == Approx(100.0 * double(j) / 12).margin(0.1));
        }
        CHECK(length == Approx(100).margin(0.01));
    }
    // Every place of the section has a fibre near, and no two share one: 49 discs of a disc of radius 10.
    for (int k = 0; k < 400; ++k) {
        const double r = 9.5 * std::sqrt((k + 0.5) / 400), a = 2.399963 * k;
        double nearest = 100;
        for (int f = 0; f < 49; ++f)
            nearest = std::min(
                nearest, (model.rest.fibre(f)[6].head<2>() - Vec2(r * std::cos(a), r * std::sin(a))).norm());
        CHECK(nearest < 2.6);
    }
    for (int f = 0; f < 49; ++f)
        for (int g = 0; g < f; ++g)
            CHECK((model.rest.fibre(f)[6] - model.rest.fibre(g)[6]).norm() > 1.0);
    for (std::size_t v = 0; v < model.field.size(); ++v)
        CHECK(model.field[v] == Approx(tube.mesh.positions[v].z() / 100).margin(1e-3));
}

TEST_CASE("streamlines: fibres of a straight tube run along it and start evenly", "[anatomy][fibres]") {
    FibreCase tube = test::tube_case();
    tube.problem.count = 30;
    const FibreModel model = decompose_streamlines(tube.problem);
    check_model(model, tube.problem);
    double covered = 0;
    for (int f = 0; f < 30; ++f) {
        const auto fibre = model.rest.fibre(f);
        double length = 0;
        for (std::size_t j = 0; j + 1 < fibre.size(); ++j)
            length += (fibre[j + 1] - fibre[j]).norm();
        CHECK(length == Approx(100).epsilon(0.03));
        CHECK((fibre.back() - fibre.front()).head<2>().norm() < 2.0);
        double nearest = 100;
        for (int g = 0; g < 30; ++g)
            if (g != f)
                nearest = std::min(nearest, (model.rest.fibre(g)[0] - fibre[0]).norm());
        covered += 3.14159265 * 0.25 * nearest * nearest;
    }
    CHECK(covered > 0.5 * 3.14159265 * 100); // discs that do not overlap fill most of the end
}

TEST_CASE("fibres of a bent, flat muscle stay inside for every template and number", "[anatomy][fibres]") {
    FibreCase muscle = test::bent_case();
    for (const int count : {1, 2, 25, 60})
        for (const int segments : {1, 2, 20})
            for (const FibreMethod& method : fibre_methods()) {
                if (method.needs_surface_fibres)
                    continue;
                muscle.problem.count = count;
                muscle.problem.segments = segments;
                check_model(method.function(muscle.problem), muscle.problem);
            }
    const FibreTemplate oblique{"oblique",
                                "Oblique",
                                "",
                                {{0, {Vec2(0, 0.6), Vec2(1, 1)}, 1}, {1, {Vec2(0, 0), Vec2(1, 0.4)}, 1}},
                                {}};
    muscle.problem.fibre_template = &oblique;
    check_model(decompose_kukacka(muscle.problem), muscle.problem);
}

TEST_CASE("kukacka: fibres do not twist along a bent muscle", "[anatomy][fibres]") {
    FibreCase muscle = test::bent_case();
    muscle.problem.count = 16;
    muscle.problem.segments = 20;
    const FibreModel model = decompose_kukacka(muscle.problem);
    // y is across the bend: a fibre keeps its share of the width.
    for (int f = 0; f < 16; ++f) {
        const auto fibre = model.rest.fibre(f);
        for (const Vec3& p : fibre)
            CHECK(std::abs(p.y() - fibre[10].y()) < 4.0); // of a width of 24
    }
}

TEST_CASE("kukacka: two heads share the fibres and end in their own origins", "[anatomy][fibres]") {
    FibreCase muscle(box_mesh(Vec3(0, 0, 0), Vec3(40, 10, 60), {24, 6, 30}));
    muscle.patch(AttachmentKind::origin, [](const Vec3& p) { return p.z() == 0 && p.x() <= 12; });
    muscle.patch(AttachmentKind::origin, [](const Vec3& p) { return p.z() == 0 && p.x() >= 28; });
    muscle.patch(AttachmentKind::insertion, [](const Vec3& p) { return p.z() == 60; });
    muscle.problem.count = 64;
    const FibreModel model = decompose_kukacka(muscle.problem);
    check_model(model, muscle.problem);
    int left = 0;
    for (int f = 0; f < 64; ++f) {
        const auto fibre = model.rest.fibre(f);
        const bool starts_left = fibre.front().x() < 20;
        left += starts_left ? 1 : 0;
        CHECK(starts_left == (fibre.back().x() < 20)); // none crosses over
        CHECK((fibre.front().x() <= 12 + 1e-9 || fibre.front().x() >= 28 - 1e-9));
    }
    CHECK(left == 32);
}

TEST_CASE("fibres: the same bits on every run and for every number of threads", "[anatomy][fibres]") {
    FibreCase muscle = test::bent_case();
    for (const FibreMethod& method : fibre_methods()) {
        if (method.needs_surface_fibres)
            continue;
        muscle.problem.threads = 1;
        const FibreModel one = method.function(muscle.problem);
        muscle.problem.threads = 3;
        const FibreModel three = method.function(muscle.problem);
        CHECK(one.rest.points == three.rest.points);
        CHECK(one.field == three.field);
        CHECK(one.carrier.weight_count() == three.carrier.weight_count());
    }
}

TEST_CASE("fibres: what cannot be is refused by name", "[anatomy][fibres]") {
    const auto check = [](const char* what, const FibreProblem& problem) {
        for (const FibreMethod& method : fibre_methods())
            if (!method.needs_surface_fibres) {
                const std::string message = message_of(problem, method.key);
                CHECK_THAT(message, Catch::Contains(what) && Catch::StartsWith("tube: fibres"));
                CHECK(message.find('\n') == std::string::npos);
            }
    };
    const FibreCase good = test::tube_case();
    FibreCase bad = good;
    bad.problem.patches.pop_back();
    check("no insertion", bad.problem);
    bad = good;
    bad.problem.patches.clear();
    check("no origin", bad.problem);
    bad = good;
    bad.problem.patches[1].vertices = bad.problem.patches[0].vertices;
    check("attached at the other end too", bad.problem);
    bad = good;
    bad.problem.patches[1].kind = AttachmentKind::unknown;
    check("attachment: neither origin nor insertion", bad.problem);
    bad = good;
    bad.problem.patches[0].vertices.clear();
    check("origin: no vertex", bad.problem);
    bad = good;
    bad.problem.patches[0].vertices.push_back(123456);
    check("vertex 123456", bad.problem);
    bad = good;
    bad.problem.patches[0].outline.emplace_back(0, std::nan(""), 0);
    check("outline is not finite", bad.problem);
    bad = good;
    bad.problem.count = 0;
    check("0 fibres", bad.problem);
    bad.problem.count = 2001;
    check("2001 fibres", bad.problem);
    bad = good;
    bad.problem.segments = 201;
    check("201 segments", bad.problem);
    bad = good;
    bad.mesh.triangles.pop_back();
    bad.refresh();
    check("open at 3 edges", bad.problem);
    bad = good;
    bad.mesh.positions[3].x() = std::nan("");
    check("vertex 3 is not finite", bad.problem);
    bad = good; // origin on one part, insertion on another
    bad.mesh = test::joined(bad.mesh, test::sphere(5, 2, Vec3(50, 0, 0)));
    bad.refresh();
    bad.problem.patches[1].vertices = {bad.mesh.vertex_count() - 1};
    check("do not hang together", bad.problem);
    bad = good; // everything attached
    bad.problem.patches[0].vertices.clear();
    bad.problem.patches[1].vertices.clear();
    for (int v = 0; v < bad.mesh.vertex_count(); ++v)
        bad.problem.patches[bad.mesh.positions[static_cast<std::size_t>(v)].z() < 50 ? 0 : 1]
            .vertices.push_back(v);
    check("no free vertex", bad.problem);
}

TEST_CASE("fibres: awkward attachments still give fibres", "[anatomy][fibres]") {
    FibreCase muscle = test::tube_case();
    const auto all_methods = [&] {
        for (const FibreMethod& method : fibre_methods())
            if (!method.needs_surface_fibres)
                check_model(method.function(muscle.problem), muscle.problem);
    };
    SECTION("single vertices") {
        muscle.problem.patches[0].vertices.resize(1);
        muscle.problem.patches[1].vertices.resize(1);
        all_methods();
    }
    SECTION("one covers nearly everything") {
        muscle.problem.patches.clear();
        muscle.patch(AttachmentKind::origin, [](const Vec3& p) { return p.z() < 90; });
        muscle.patch(AttachmentKind::insertion, [](const Vec3& p) { return p.z() == 100; });
        all_methods();
    }
    SECTION("side by side on one face") {
        muscle.problem.patches.clear();
        muscle.patch(AttachmentKind::origin, [](const Vec3& p) { return p.z() == 0 && p.x() < -3; });
        muscle.patch(AttachmentKind::insertion, [](const Vec3& p) { return p.z() == 0 && p.x() > 3; });
        all_methods();
    }
    SECTION("overlapping in part, with a note") {
        const auto& other = muscle.problem.patches[1].vertices;
        auto& vertices = muscle.problem.patches[0].vertices;
        vertices.insert(vertices.end(), other.begin(), other.begin() + 5);
        const FibreModel model = decompose_kukacka(muscle.problem);
        REQUIRE_FALSE(model.notes.empty());
        CHECK_THAT(model.notes[0], Catch::Contains("10 vertices are attached at both ends"));
        CHECK(model.rest.count == muscle.problem.count);
    }
    SECTION("a second part without attachments, with a note") {
        muscle.mesh = test::joined(muscle.mesh, test::sphere(5, 2, Vec3(50, 0, 0)));
        muscle.refresh();
        const FibreModel model = decompose_kukacka(muscle.problem);
        REQUIRE_FALSE(model.notes.empty());
        CHECK_THAT(model.notes[0], Catch::Contains("1 of 2 separate parts"));
        check_model(model, muscle.problem);
    }
    SECTION("in metres") {
        for (Vec3& p : muscle.mesh.positions)
            p *= 1e-3;
        muscle.problem.unit_mm = 1000;
        const FibreModel model = decompose_kukacka(muscle.problem);
        CHECK((model.rest.fibre(0).back() - model.rest.fibre(0).front()).norm() == Approx(0.1).epsilon(0.01));
    }
}
