#include "fascicle/geometry/dihedral_angle.hpp"
#include "fascicle/metrics/dihedral_change.hpp"
#include "fascicle/scene/muscle_stiffness.hpp"
#include "fascicle/simulation/prepare.hpp"
#include "support/shapes.hpp"
#include "view/build_draw_list.hpp"
#include "view/vertex_means.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <thread>

using namespace fascicle;
using namespace fascicle::view;

namespace {

/// A sheet of nx x ny squares between two bones at its ends; attached there.
Scene sheet_scene(int nx = 6, int ny = 3) {
    Scene scene;
    TriMesh left = test::box(2, double(ny) + 2, 2), right = left;
    for (Vec3& p : left.positions)
        p += Vec3(-2.5, -1, -1);
    for (Vec3& p : right.positions)
        p += Vec3(nx + 0.5, -1, -1);
    scene.bones = {{"left", std::make_shared<const TriMesh>(left), {}},
                   {"right", std::make_shared<const TriMesh>(right), {}}};
    Muscle muscle;
    muscle.name = "sheet";
    muscle.mesh = std::make_shared<const TriMesh>(test::sheet(nx, ny));
    Attachment origin{AttachmentKind::origin, 0, {}}, insertion{AttachmentKind::insertion, 1, {}};
    for (int v = 0; v < muscle.mesh->vertex_count(); ++v) {
        const double x = muscle.mesh->positions[static_cast<std::size_t>(v)].x();
        if (x == 0)
            origin.vertices.push_back(v);
        if (x == nx)
            insertion.vertices.push_back(v);
    }
    muscle.attachments = {origin, insertion};
    scene.muscles = {muscle};
    return scene;
}

/// A ball between two blocks, touched by neither, attached at its poles.
Scene ball_scene() {
    Scene scene;
    TriMesh left = test::box(10, 30, 30), right = left;
    for (Vec3& p : left.positions)
        p += Vec3(-26, -15, -15);
    for (Vec3& p : right.positions)
        p += Vec3(16, -15, -15);
    scene.bones = {{"left", std::make_shared<const TriMesh>(left), {}},
                   {"right", std::make_shared<const TriMesh>(right), {}}};
    Muscle muscle;
    muscle.name = "ball";
    muscle.mesh = std::make_shared<const TriMesh>(test::sphere(15, 3));
    Attachment origin{AttachmentKind::origin, 0, {}}, insertion{AttachmentKind::insertion, 1, {}};
    for (int v = 0; v < muscle.mesh->vertex_count(); ++v) {
        const double x = muscle.mesh->positions[static_cast<std::size_t>(v)].x();
        if (x < -12)
            origin.vertices.push_back(v);
        if (x > 12)
            insertion.vertices.push_back(v);
    }
    muscle.attachments = {origin, insertion};
    scene.muscles = {muscle};
    scene.parameters.set("fibres.count", 8);
    scene.parameters.set("fibres.segments", 6);
    return scene;
}

MeshTopology topology_of(const Muscle& muscle) {
    return MeshTopology(muscle.mesh->vertex_count(), muscle.mesh->triangles);
}

} // namespace

TEST_CASE("Dihedral change is nought at rest and the angle of a fold along the fold alone",
          "[view][colour_values]") {
    const TriMesh mesh = test::sheet(4, 2);
    const MeshTopology topology(mesh.vertex_count(), mesh.triangles);
    const VertexDihedralChange change(topology, mesh.positions);
    for (const double value : change.measure(mesh.positions))
        CHECK(value == 0.0);
    for (const double degrees : {30.0, -50.0}) {
        Points folded = mesh.positions; // about the line x = 2
        const double angle = degrees * std::numbers::pi / 180;
        for (Vec3& p : folded)
            if (p.x() > 2)
                p = Vec3(2 + (p.x() - 2) * std::cos(angle), p.y(), (p.x() - 2) * std::sin(angle));
        const std::vector<double> values = change.measure(folded);
        for (std::size_t v = 0; v < values.size(); ++v) {
            // Brute force: of all edges with two triangles that end here, those on the line have the whole angle.
            double sum = 0;
            int count = 0;
            for (const Dihedral& d : topology.dihedrals())
                if (d.p2 == static_cast<int>(v) || d.p3 == static_cast<int>(v)) {
                    const bool on_fold = mesh.positions[static_cast<std::size_t>(d.p2)].x() == 2 &&
                                         mesh.positions[static_cast<std::size_t>(d.p3)].x() == 2;
                    sum += on_fold ? std::abs(degrees) : 0.0;
                    ++count;
                }
            CHECK(values[v] == Approx(count > 0 ? sum / count : 0.0).margin(1e-9));
        }
    }
}

TEST_CASE("The dihedral changes of all vertices add up to the metric's mean", "[view][colour_values]") {
    const TriMesh mesh = test::sphere(10, 2);
    const MeshTopology topology(mesh.vertex_count(), mesh.triangles);
    Points moved = mesh.positions;
    for (std::size_t i = 0; i < moved.size(); ++i)
        moved[i] += Vec3(0.6 * std::sin(double(i)), 0.4 * std::cos(2.0 * double(i)), 0);
    const std::vector<double> values = VertexDihedralChange(topology, mesh.positions).measure(moved);
    double sum = 0;
    for (std::size_t v = 0; v < values.size(); ++v)
        sum += values[v] * double(topology.vertex_neighbours(static_cast<int>(v)).size());
    const double mean = sum / (2.0 * double(topology.dihedrals().size()));
    const DihedralChange metric = DihedralChangeMeasure(topology.dihedrals(), mesh.positions).measure(moved);
    CHECK(mean == Approx(metric.mean_rad * 180 / std::numbers::pi));
}

TEST_CASE("The harmonic field of a sheet is its place from end to end", "[view][colour_values]") {
    const Scene scene = sheet_scene();
    const Muscle& muscle = scene.muscles[0];
    const std::vector<double> field =
        origin_to_insertion_field(scene, muscle, topology_of(muscle), muscle.attachments);
    REQUIRE(field.size() == muscle.mesh->positions.size());
    for (std::size_t v = 0; v < field.size(); ++v)
        CHECK(field[v] == Approx(muscle.mesh->positions[v].x() / 6).margin(1e-9));
    // One end alone has no field
    CHECK(origin_to_insertion_field(scene, muscle, topology_of(muscle), {muscle.attachments[0]}).empty());
}

TEST_CASE("The harmonic field of a closed muscle runs from 0 to 1 and not beyond", "[view][colour_values]") {
    const auto scene = std::make_shared<const Scene>(ball_scene());
    RestFields fields;
    const std::vector<Attachment>& attachments = scene->muscles[0].attachments;
    const VertexValues field = fields.values(RestField::harmonic, {scene, 0, attachments, nullptr});
    REQUIRE(field != nullptr);
    for (const double value : *field) {
        CHECK(value >= 0.0);
        CHECK(value <= 1.0);
    }
    for (const int v : attachments[0].vertices)
        CHECK((*field)[static_cast<std::size_t>(v)] == 0.0);
    for (const int v : attachments[1].vertices)
        CHECK((*field)[static_cast<std::size_t>(v)] == 1.0);
}

TEST_CASE("Softened stiffness is the share that one projection removes", "[scene][colour_values]") {
    for (const double k : {0.05, 0.5, 0.9})
        for (const double s : {0.02, 0.5, 1.0}) {
            // xpbd: W / (W + alpha / h^2) with alpha = h^2 W (1 - k) / k / s; h and W cancel
            CHECK(softened_stiffness(k, s, false) == Approx(1 / (1 + (1 - k) / k / s)));
            CHECK(softened_stiffness(k, s, true) == Approx(k * s));
        }
    CHECK(softened_stiffness(1, 0.3, false) == 1.0);
    CHECK(softened_stiffness(0, 0.3, false) == 0.0);
    CHECK(softened_stiffness(0.7, 1, false) == Approx(0.7));
}

TEST_CASE("Stiffness k is that of the edges the solver is given", "[view][colour_values]") {
    for (const char* method : {"xpbd", "classic"})
        for (const double anisotropy : {0.0, 1.0, 1.7})
            for (const char* fibres : {"none", "streamlines"}) {
                INFO(method << " " << anisotropy << " " << fibres);
                Scene made = ball_scene();
                made.parameters.set_text("solver.method", method);
                made.parameters.set("solver.stiffness", 0.8);
                made.parameters.set("solver.anisotropy", anisotropy);
                made.parameters.set_text("fibres.method", fibres);
                const auto scene = std::make_shared<const Scene>(std::move(made));
                const PreparedScene prepared = prepare_scene(*scene, 1, {});
                const PreparedMuscle& muscle = prepared.muscles[0];
                RestFields fields;
                const VertexValues seen =
                    fields.values(RestField::stiffness, {scene, 0, muscle.attachments, muscle.fibres});
                REQUIRE(seen != nullptr);
                const MeshTopology topology = topology_of(scene->muscles[0]);
                const std::vector<double>& softness = muscle.problem.edge_softness;
                std::vector<double> sums(seen->size(), 0.0), counts(seen->size(), 0.0);
                for (std::size_t e = 0; e < topology.edges().size(); ++e) {
                    const double s = softness.empty() ? 1.0 : softness[e];
                    const double k = std::string(method) == "classic" ? 0.8 * s : 0.8 * s / (0.2 + 0.8 * s);
                    for (const int v : {topology.edges()[e].a, topology.edges()[e].b}) {
                        sums[static_cast<std::size_t>(v)] += k;
                        counts[static_cast<std::size_t>(v)] += 1;
                    }
                }
                double lowest = 1, highest = 0;
                for (std::size_t v = 0; v < seen->size(); ++v) {
                    CHECK((*seen)[v] == Approx(sums[v] / counts[v]));
                    lowest = std::min(lowest, (*seen)[v]);
                    highest = std::max(highest, (*seen)[v]);
                }
                // It differs from place to place wherever the solver knows of fibres
                CHECK((highest - lowest > 0.05) == !softness.empty());
                CHECK((softness.empty()) == (anisotropy == 0.0 || (std::string(method) == "classic" &&
                                                                   std::string(fibres) == "none")));
            }
}

TEST_CASE("Distance to bone is brute force's, nought inside and cut at no end of the scale",
          "[view][colour_values]") {
    Scene made = ball_scene();
    const auto scene = std::make_shared<const Scene>(std::move(made));
    ViewSubject subject = subject_of(scene);
    ViewOptions options;
    options.colouring = Colouring::distance;
    options.scales[Colouring::distance].high = 16;
    DrawCache cache;
    const render::DrawList list = build_draw_list(subject, options, {}, cache);
    const Points& points = scene->muscles[0].mesh->positions;
    for (const render::SurfaceItem& item : list.surfaces) {
        if (item.id != muscle_item_id(0))
            continue;
        REQUIRE(item.vertex_colours != nullptr);
        for (std::size_t v = 0; v < points.size(); ++v) {
            // Each block is as wide as the ball: the distance is that of the planes x = -16 and x = 16.
            const double distance = std::min(points[v].x() + 16, 16 - points[v].x());
            const render::Rgba expected = options.scales[Colouring::distance].colour(distance);
            for (std::size_t c = 0; c < 3; ++c)
                CHECK((*item.vertex_colours)[v][c] == Approx(expected[c]).margin(1e-4));
        }
    }
}

TEST_CASE("In the background a field comes later, once, and again when what it is made from changes",
          "[view][colour_values]") {
    auto scene = std::make_shared<const Scene>(ball_scene());
    RestFields fields;
    fields.set_background(true);
    const auto ask = [&] {
        return fields.values(RestField::stiffness, {scene, 0, scene->muscles[0].attachments, nullptr});
    };
    const auto wait = [&] {
        for (int i = 0; i < 5000 && !fields.collect(); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        CHECK_FALSE(fields.waiting());
    };
    CHECK(ask() == nullptr);
    CHECK(fields.waiting());
    wait();
    const VertexValues first = ask();
    REQUIRE(first != nullptr);
    CHECK(fields.computed() == 1);
    CHECK(ask() == first);
    // Another scene with the same muscle and parameters gives the same array
    Scene other = *scene;
    other.name = "another";
    other.parameters.set("solver.damping", 7);
    scene = std::make_shared<const Scene>(other);
    CHECK(ask() == first);
    CHECK_FALSE(fields.waiting());
    // Another stiffness another one; meanwhile the old is shown
    other.parameters.set("solver.stiffness", 0.4);
    scene = std::make_shared<const Scene>(other);
    CHECK(ask() == first);
    wait();
    const VertexValues second = ask();
    REQUIRE(second != nullptr);
    CHECK((*second)[0] < (*first)[0]);
    // Somebody who cannot wait for later, such as a picture in a file
    other.parameters.set("solver.stiffness", 0.9);
    scene = std::make_shared<const Scene>(other);
    fields.set_background(false);
    CHECK((*ask())[0] == (*first)[0]);
}

TEST_CASE("A muscle that has no such field is grey", "[view][colour_values]") {
    Scene made = ball_scene();
    made.muscles[0].attachments.clear();
    const auto scene = std::make_shared<const Scene>(std::move(made));
    ViewOptions options;
    options.colouring = Colouring::harmonic;
    DrawCache cache;
    const render::DrawList list = build_draw_list(subject_of(scene), options, {}, cache);
    for (const render::SurfaceItem& item : list.surfaces)
        if (item.id == muscle_item_id(0)) {
            CHECK(item.vertex_colours == nullptr);
            CHECK(item.colour == palette::no_value);
        }
}

TEST_CASE("Scales of the table are made for any colour vision and stay within their limits",
          "[view][colouring]") {
    for (const ColouringRow& row : colourings()) {
        INFO(row.key);
        if (!row.has_scale())
            continue;
        CHECK(row.scale.low < row.scale.high);
        CHECK(row.least <= row.scale.low);
        CHECK(row.most >= row.scale.high);
        // Signed values and ratios about one have a middle, and only they the diverging map.
        CHECK((row.scale.map == ColourMap::diverging) == row.scale.middle.has_value());
        CHECK(legend_ticks(row.scale).size() >= 3);
        ColourScale scale = row.scale;
        set_range(scale, row, -1e9, 1e9);
        CHECK(scale.low == row.least);
        CHECK(scale.high == row.most);
        set_range(scale, row, 1e9, -1e9); // the wrong way round: still a range
        CHECK(scale.low < scale.high);
        if (scale.middle) {
            CHECK(scale.low < *scale.middle);
            CHECK(scale.high > *scale.middle);
        }
        const ColourScale before = scale;
        set_range(scale, row, std::nan(""), std::nan(""));
        CHECK(scale == before);
    }
    CHECK(std::string(colouring_row(Colouring::distance).unit) == "mm");
}

TEST_CASE("A section and occlusion reach the draw list", "[view][build_draw_list]") {
    const auto scene = std::make_shared<const Scene>(ball_scene());
    ViewOptions options;
    DrawCache cache;
    const render::DrawList plain = build_draw_list(subject_of(scene), options, {}, cache);
    CHECK_FALSE(plain.section);
    CHECK(plain.occlusion_radius == 0.0f);
    options.section = SectionPlane{Vec3::UnitZ(), 4.0};
    options.occlusion = true;
    const render::DrawList list = build_draw_list(subject_of(scene), options, {}, cache);
    REQUIRE(list.section);
    CHECK(*list.section == std::array<float, 4>{0, 0, -1, 4}); // z <= 4 stays
    CHECK(list.occlusion_radius > 1.0f);
    CHECK(list.occlusion_radius < 10.0f);
    for (const render::SurfaceItem& item : list.surfaces)
        CHECK(item.cap[3] == 1.0f); // bones and muscles are solids
    DrawCache empty;
    CHECK(build_draw_list(subject_of(std::make_shared<const Scene>()), options, {}, empty).occlusion_radius ==
          0.0f);
}
