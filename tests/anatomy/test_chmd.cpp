#include "anatomy/chmd_cases.hpp"
#include "fascicle/anatomy/fibre_methods.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/geometry/solid_query.hpp"
#include "geometry/surface_oracles.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;
using Catch::Matchers::Contains;

namespace {

void fails(const FibreProblem& problem, const std::string& words) {
    try {
        decompose_chmd(problem);
        FAIL("no error; expected: " << words);
    } catch (const Error& error) {
        CHECK_THAT(error.what(), Contains(words) && Contains("strap") && Contains("expected"));
        CHECK(std::string(error.what()).find('\n') == std::string::npos);
    }
}

/// Every point inside or at most `tolerance` outside, the ends on the patches.
void check_fibres(const FibreModel& model, const test::ChmdCase& made, double tolerance) {
    const SolidQuery solid(made.mesh);
    const auto on_patch = [&](const Vec3& p, AttachmentKind kind) {
        double nearest = 1e300;
        for (const AttachmentPatch& patch : made.patches)
            if (patch.kind == kind) {
                TriMesh area{made.mesh.positions, {}};
                for (const Tri& t : made.mesh.triangles)
                    if (std::all_of(t.begin(), t.end(), [&](int v) {
                            return std::binary_search(patch.vertices.begin(), patch.vertices.end(), v);
                        }))
                        area.triangles.push_back(t);
                nearest = std::min(nearest, TriangleBvh(area).closest(p).squared_distance);
            }
        return std::sqrt(nearest);
    };
    for (int f = 0; f < model.rest.count; ++f) {
        const auto fibre = model.rest.fibre(f);
        for (const Vec3& p : fibre) {
            REQUIRE(p.allFinite());
            CHECK(solid.signed_distance(p) <= tolerance);
        }
        if (f < 40) {
            CHECK(on_patch(fibre.front(), AttachmentKind::origin) < 1e-9);
            CHECK(on_patch(fibre.back(), AttachmentKind::insertion) < 1e-9);
        }
    }
}

} // namespace

TEST_CASE("CHMD: any number of fibres and segments, inside, from origin to insertion", "[anatomy][chmd]") {
    test::ChmdCase box = test::box_case(), ellipsoid = test::ellipsoid_case();
    for (test::ChmdCase* made : {&box, &ellipsoid})
        for (const auto& [count, segments] :
             std::vector<std::pair<int, int>>{{1, 1}, {2, 200}, {37, 4}, {100, 15}, {300, 2}}) {
            INFO(count << " x " << segments);
            const FibreModel model = decompose_chmd(made->problem(count, segments, 2));
            REQUIRE(model.rest.count == count);
            REQUIRE(model.rest.segments == segments);
            REQUIRE(model.rest.points.size() == std::size_t(count) * std::size_t(segments + 1));
            CHECK(model.carrier.point_count() == model.rest.points.size());
            CHECK(model.field.empty());
            check_fibres(model, *made, 1e-3);
        }
}

TEST_CASE("CHMD: fibres of a box are straight and as long as it", "[anatomy][chmd]") {
    test::ChmdCase box = test::box_case();
    const FibreModel model = decompose_chmd(box.problem(100, 15));
    double mean = 0;
    for (int f = 0; f < 100; ++f) {
        const auto fibre = model.rest.fibre(f);
        double length = 0, longest = 0, shortest = 1e300;
        for (std::size_t k = 1; k < fibre.size(); ++k) {
            const double step = (fibre[k] - fibre[k - 1]).norm();
            length += step;
            longest = std::max(longest, step);
            shortest = std::min(shortest, step);
        }
        CHECK(length >= 100.0 - 1e-9);
        CHECK(length < 115.0);
        CHECK(longest < 1.05 * shortest); // equal arcs
        mean += length / 100;
    }
    CHECK(mean < 103.0);
    // The cross-section in the middle is filled: all quarters of the width, both halves of the depth.
    int cells[4][2] = {};
    for (int f = 0; f < 100; ++f) {
        const Vec3& p = model.rest.fibre(f)[7];
        ++cells[std::clamp(int(p.x() / 15.0), 0, 3)][p.y() > 10 ? 1 : 0];
    }
    for (const auto& column : cells)
        for (const int n : column)
            CHECK(n >= 4);
}

TEST_CASE("CHMD: two bars are two heads and no fibre crosses between them", "[anatomy][chmd]") {
    test::ChmdCase bars = test::two_bars_case();
    const FibreModel model = decompose_chmd(bars.problem(60, 10));
    int left = 0;
    for (int f = 0; f < 60; ++f) {
        const auto fibre = model.rest.fibre(f);
        const bool on_left = fibre.front().x() < 30;
        for (const Vec3& p : fibre)
            CHECK((on_left ? p.x() <= 20.0 + 1e-9 : p.x() >= 40.0 - 1e-9));
        left += on_left ? 1 : 0;
    }
    CHECK(std::abs(left - 30) <= 6);
    CHECK_THAT(model.notes.at(0), Contains("2 heads at the origin"));
    CHECK_THAT(model.notes.at(1), Contains("2 heads at the insertion"));
    check_fibres(model, bars, 1e-3);
}

TEST_CASE("CHMD: the same bits on any number of threads, in any order and direction of the given fibres",
          "[anatomy][chmd]") {
    test::ChmdCase made = test::ellipsoid_case();
    const Points one = decompose_chmd(made.problem(90, 12, 1)).rest.points;
    for (const int threads : {2, 5})
        CHECK(decompose_chmd(made.problem(90, 12, threads)).rest.points == one);
    std::swap(made.fibres.lines[0], made.fibres.lines[3]);
    std::swap(made.fibres.lines[1], made.fibres.lines[2]);
    std::reverse(made.fibres.lines[1].begin(), made.fibres.lines[1].end());
    std::reverse(made.fibres.lines[4].begin(), made.fibres.lines[4].end());
    CHECK(decompose_chmd(made.problem(90, 12, 2)).rest.points == one);
}

TEST_CASE("CHMD: a scene in metres gives the fibres of the scene in millimetres", "[anatomy][chmd]") {
    test::ChmdCase made = test::box_case();
    const Points in_mm = decompose_chmd(made.problem(50, 10)).rest.points;
    for (Points* points : {&made.mesh.positions, &made.fibres.points})
        for (Vec3& p : *points)
            p *= 1e-3;
    FibreProblem problem = made.problem(50, 10);
    problem.unit_mm = 1000;
    const Points in_m = decompose_chmd(problem).rest.points;
    for (std::size_t i = 0; i < in_mm.size(); ++i)
        CHECK((1e3 * in_m[i] - in_mm[i]).norm() < 1e-6);
}

TEST_CASE("CHMD: bad input is said in one line that names the muscle", "[anatomy][chmd]") {
    test::ChmdCase made = test::box_case();
    const auto with = [&](const std::function<void(test::ChmdCase&)>& change, const std::string& words) {
        test::ChmdCase bad = test::box_case();
        change(bad);
        fails(bad.problem(10, 5), words);
    };
    with([](auto& c) { c.fibres.lines.resize(1); }, "there is 1 surface fibre; expected 2 to 500");
    with([](auto& c) { c.fibres.lines.clear(); }, "there are 0 surface fibres");
    with([](auto& c) { c.fibres.lines.resize(501, c.fibres.lines[0]); }, "there are 501 surface fibres");
    with([](auto& c) { c.fibres.lines[1].resize(1); }, "surface fibre 2 has fewer than 2 different points");
    with([](auto& c) { c.fibres.lines[2].clear(); }, "surface fibre 3 has fewer than 2 different points");
    with([](auto& c) { c.fibres.points[1] = c.fibres.points[2] = c.fibres.points[0]; },
         "surface fibre 1 has fewer than 2 different points");
    with([](auto& c) { c.fibres.lines[1][1] = 99; }, "surface fibre 2 uses point 99, which does not exist");
    with([](auto& c) { c.fibres.points[0].x() = std::nan(""); },
         "surface fibre 1 has a point that is not finite");
    with(
        [](auto& c) {
            for (Vec3& p : c.fibres.points)
                p.y() -= 40;
        },
        "surface fibre 1 lies 40.0 mm from the muscle's surface on average; expected superficial fibres of "
        "this muscle");
    with([](auto& c) { c.patches.pop_back(); }, "no insertion is attached");
    with([](auto& c) { c.patches.erase(c.patches.begin()); }, "no origin is attached");
    with([](auto& c) { c.patches[0].kind = AttachmentKind::unknown; }, "is neither origin nor insertion");
    with([](auto& c) { c.patches[1].vertices.clear(); }, "insertion on block holds no vertex");
    with([](auto& c) { c.patches[1].vertices.push_back(100000); }, "insertion on block uses vertex 100000");
    with([](auto& c) { c.mesh.triangles.resize(c.mesh.triangles.size() - 3); }, "the surface has holes");
    with([](auto& c) { c.mesh = test::inside_out(c.mesh); }, "inside out");
    with([](auto& c) { c.mesh.triangles.clear(); }, "has no surface");
    with([](auto& c) { c.mesh.positions[3].z() = INFINITY; }, "a vertex is not finite");
    for (const int count : {0, -3, 2001})
        fails(made.problem(count, 5),
              "the number of fibres is " + std::to_string(count) + "; expected 1 to 2000");
    for (const int segments : {0, 201})
        fails(made.problem(5, segments), "the number of segments is " + std::to_string(segments));
    FibreProblem none = made.problem(5, 5);
    none.surface_fibres = nullptr;
    fails(none, "CHMD needs superficial fibres and there are none");
}

TEST_CASE("CHMD: odd but usable input", "[anatomy][chmd]") {
    SECTION("two fibres that are the same") {
        test::ChmdCase made = test::box_case();
        made.fibres.lines = {made.fibres.lines[0], made.fibres.lines[0]};
        check_fibres(decompose_chmd(made.problem(30, 8)), made, 1e-3);
    }
    SECTION("fibres that meet in one point") {
        test::ChmdCase made = test::box_case();
        made.fibres = {};
        for (const double x : {10.0, 30.0, 50.0})
            made.add_fibre({Vec3(x, 0, 95), Vec3(x, 0, 60), Vec3(30, 0, 5)});
        check_fibres(decompose_chmd(made.problem(30, 8)), made, 1e-3);
    }
    SECTION("an attachment of three lone vertices") {
        test::ChmdCase made = test::box_case();
        std::vector<int>& vertices = made.patches[0].vertices;
        vertices = {vertices[0], vertices[20], vertices[40]};
        const FibreModel model = decompose_chmd(made.problem(30, 8));
        for (int f = 0; f < 30; ++f) {
            double nearest = 1e300;
            for (const int v : vertices)
                nearest = std::min(
                    nearest, (model.rest.fibre(f).front() - made.mesh.positions[std::size_t(v)]).norm());
            CHECK(nearest < 1e-9);
        }
    }
    SECTION("a muscle as thin as paper") {
        test::ChmdCase made = test::box_case();
        for (Vec3& p : made.mesh.positions)
            p.y() *= 1e-3;
        check_fibres(decompose_chmd(made.problem(30, 8)), made, 1e-3);
    }
    SECTION("fibres beside the muscle are laid onto it") {
        test::ChmdCase made = test::box_case();
        for (Vec3& p : made.fibres.points)
            p.y() = -8;
        const FibreModel model = decompose_chmd(made.problem(30, 8));
        check_fibres(model, made, 1e-3);
        CHECK_THAT(model.notes.at(0), Contains("up to 8.0 mm"));
    }
}

TEST_CASE("CHMD: random fibres, attachments and shapes give finite fibres inside, from origin to insertion",
          "[anatomy][chmd]") {
    test::Random random(21);
    for (int trial = 0; trial < 40; ++trial) {
        INFO("trial " << trial);
        test::ChmdCase made;
        made.mesh = trial % 3 == 0   ? test::torus(30, 8 + trial % 7)
                    : trial % 3 == 1 ? test::joined(test::sphere(20, 2), test::sphere(15, 2, Vec3(28, 0, 3)))
                                     : test::sphere(25, 2);
        for (const AttachmentKind kind :
             {AttachmentKind::origin, AttachmentKind::insertion, AttachmentKind::origin}) {
            const Vec3 centre = made.mesh.positions[random.index(made.mesh.positions.size())];
            const double reach = random.real(4, 20); // triangles, or single vertices
            made.add_patch(kind, [&](const Vec3& p) { return (p - centre).norm() < reach; });
        }
        const int fibres = 2 + static_cast<int>(random.index(6));
        for (int i = 0; i < fibres; ++i) {
            Points line;
            for (std::size_t k = 0; k < 2 + random.index(6); ++k)
                line.push_back(random.on_surface(made.mesh) + random.real(0, 4) * random.direction());
            made.add_fibre(line);
        }
        const int count = 1 + static_cast<int>(random.index(60)),
                  segments = 1 + static_cast<int>(random.index(20));
        const FibreModel model = decompose_chmd(made.problem(count, segments));
        REQUIRE(model.rest.points.size() == std::size_t(count) * std::size_t(segments + 1));
        const SolidQuery solid(made.mesh);
        for (const Vec3& p : model.rest.points) {
            REQUIRE(p.allFinite());
            REQUIRE(solid.signed_distance(p) < 0.01);
        }
    }
}
