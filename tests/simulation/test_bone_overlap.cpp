#include "fascicle/geometry/bounding_box.hpp"
#include "fascicle/geometry/solid_query.hpp"
#include "fascicle/geometry/subdivide.hpp"
#include "fascicle/io/load_scene.hpp"
#include "simulation/bone_overlap.hpp"
#include "simulation/vertex_clusters.hpp"
#include "support/data_dir.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>
#include <deque>

using namespace fascicle;
using namespace fascicle::test;

namespace {

TriMesh fine_box(const Vec3& low, const Vec3& size) {
    TriMesh mesh = box(size.x(), size.y(), size.z());
    for (Vec3& p : mesh.positions)
        p += low;
    for (int level = 0; level < 3; ++level)
        mesh = subdivide(mesh).mesh;
    return mesh;
}

/// Bones with all that is needed to look them up.
struct Bones {
    std::deque<TriMesh> meshes;
    std::deque<TriangleBvh> trees;
    std::deque<DistanceGrid> grids;
    std::vector<OverlapBone> bones;
    void add(const TriMesh& mesh, bool grid = true) {
        meshes.push_back(mesh);
        trees.emplace_back(mesh);
        if (grid)
            grids.emplace_back(mesh, DistanceGridOptions{});
        bones.push_back({&meshes.back(), &trees.back(), grid ? &grids.back() : nullptr});
    }
};

/// Every vertex in every frame from the first on, exactly.
double deepest(const Bones& bones, const Timeline& timeline, int first_frame = 0) {
    double depth = 0;
    for (int from = 0; from < 2; ++from) {
        const int to = 1 - from;
        const SolidQuery query(bones.meshes[static_cast<std::size_t>(to)]);
        for (int frame = first_frame; frame <= timeline.last_frame; ++frame)
            for (const Vec3& p : bones.meshes[static_cast<std::size_t>(from)].positions)
                depth = std::max(depth, -query.signed_distance(timeline.bone_pose(to, frame).apply_inverse(
                                            timeline.bone_pose(from, frame).apply(p))));
    }
    return depth;
}

} // namespace

TEST_CASE("clusters hold every used vertex once, within their radius", "[simulation][bone_overlap]") {
    TriMesh mesh = sphere(10, 4);
    mesh.positions.emplace_back(1000, 0, 0); // used by no triangle
    const VertexClusters all = cluster_vertices(mesh, 32);
    CHECK(all.points.size() == mesh.positions.size() - 1);
    int next = 0;
    for (const VertexCluster& cluster : all.clusters) {
        CHECK(cluster.begin == next);
        CHECK((cluster.end > cluster.begin && cluster.end - cluster.begin <= 32));
        CHECK(cluster.radius < 6);
        for (int i = cluster.begin; i < cluster.end; ++i)
            CHECK((all.points[static_cast<std::size_t>(i)] - cluster.centre).norm() <= cluster.radius);
        next = cluster.end;
    }
    CHECK(next == static_cast<int>(all.points.size()));
    CHECK(cluster_vertices({}, 32).clusters.empty());
}

TEST_CASE("two boxes that overlap at rest, by a known depth", "[simulation][bone_overlap]") {
    const bool grid = GENERATE(true, false);
    Bones bones;
    bones.add(fine_box(Vec3(0, 0, 0), Vec3(20, 20, 20)), grid);
    bones.add(fine_box(Vec3(19.25, 5, 5), Vec3(10, 10, 10)), grid);
    bones.add(fine_box(Vec3(40, 0, 0), Vec3(5, 5, 5)), grid);
    Timeline still;
    const auto found = find_bone_overlaps(bones.bones, still, 0.1);
    REQUIRE(found.size() == 1);
    CHECK((found[0].a == 0 && found[0].b == 1));
    CHECK(found[0].depth == Approx(0.75).margin(1e-9));
    CHECK((found[0].frame == 0 && found[0].first_frame == 0));
    CHECK(std::abs(found[0].place.x() - 19.625) == Approx(0.375)); // on either face
    CHECK(find_bone_overlaps(bones.bones, still, 0.8).empty());
    CHECK(find_bone_overlaps({}, still, 0.1).empty());

    Scene scene;
    scene.bones = {{"pelvis", nullptr, {}}, {"femur", nullptr, {}}};
    const std::string end = ": where bones overlap no muscle can lie outside of both";
    CHECK(overlap_note(scene, found[0]) == "pelvis and femur overlap by 0.75 mm at rest" + end);
    BoneOverlap later = found[0];
    later.frame = 100;
    CHECK(overlap_note(scene, later) ==
          "pelvis and femur overlap by 0.75 mm at frame 100 (largest), from rest on" + end);
    later.first_frame = 63;
    scene.unit = LengthUnit::metre;
    later.depth = 0.00074;
    CHECK(overlap_note(scene, later) ==
          "pelvis and femur overlap by 0.74 mm at frame 100 (largest), from frame 63 on" + end);
}

TEST_CASE("a box that is moved into another and back", "[simulation][bone_overlap]") {
    const bool grid = GENERATE(true, false);
    const bool first_moves = GENERATE(true, false); // then the other one, the other way
    Bones bones;
    bones.add(fine_box(Vec3(0, 0, 0), Vec3(20, 20, 20)), grid);
    bones.add(fine_box(Vec3(25, 5, 5), Vec3(10, 10, 10)), grid);
    // 0.1 a frame: touches at frame 50, deepest at frame 65.
    const Timeline timeline =
        make_shift_timeline(Vec3(first_moves ? 6.5 : -6.5, 0, 0), {65, 65, 20}, 2, first_moves ? 0 : 1);
    const auto found = find_bone_overlaps(bones.bones, timeline, 0.12);
    REQUIRE(found.size() == 1);
    CHECK(found[0].depth == Approx(1.5).margin(1e-9));
    CHECK(found[0].frame == 65);
    CHECK(found[0].first_frame == 52);
    const double x = found[0].place.x(), other = first_moves ? 26.5 : 20.0; // on either face
    CHECK(std::min(std::abs(x - other), std::abs(x - (first_moves ? 25.0 : 18.5))) < 1e-9);

    // Together they do not move against each other.
    Timeline together = timeline;
    together.bone_tracks[first_moves ? 1 : 0] = timeline.bone_tracks[first_moves ? 0 : 1];
    CHECK(find_bone_overlaps(bones.bones, together, 0.12).empty());
}

TEST_CASE("a long motion is thinned, and the deepest place is near that of every frame",
          "[simulation][bone_overlap]") {
    Bones bones;
    bones.add(sphere(10, 4));
    bones.add(fine_box(Vec3(11, -5, -5), Vec3(10, 10, 10)));
    const Timeline timeline = make_hinge_timeline({Vec3(16, 0, 0), Vec3::UnitZ()}, 1.5, {400, 0, 0}, 2, {1});
    const auto found = find_bone_overlaps(bones.bones, timeline, 0.1);
    REQUIRE(found.size() == 1);
    CHECK(found[0].depth == Approx(deepest(bones, timeline)).epsilon(0.02));
    CHECK(found[0].frame > found[0].first_frame);
}

TEST_CASE("LHDL: femur and pelvis overlap about the published centre and not about the fitted one",
          "[simulation][bone_overlap][data]") {
    FASCICLE_NEED_DATA(data);
    Bones bones;
    const auto scene_about = [&](const char* hinge) {
        SceneRequest request;
        request.bones = {data / "lhdl/pelvis.obj"};
        request.moving_bones = {data / "lhdl/femur.vtk"};
        request.hinge = parse_hinge(hinge);
        request.angle_deg = -57.29578;
        return load_scene(request).scene;
    };
    const Scene published = scene_about("146,238,-431;1,0,0");
    for (const Bone& bone : published.bones)
        bones.add(*bone.mesh);
    const auto found = find_bone_overlaps(bones.bones, published.timeline, 0.1);
    REQUIRE(found.size() == 1);
    CHECK(found[0].frame == 100);
    CHECK((found[0].first_frame > 50 && found[0].first_frame < 100));
    Timeline flexed = published.timeline;
    flexed.last_frame = 100;
    CHECK(found[0].depth == Approx(deepest(bones, flexed, 100)).epsilon(1e-9));
    CHECK(found[0].depth > 0.6);
    CHECK(find_bone_overlaps(bones.bones, scene_about("143.86,243.37,-432.53;1,0,0").timeline, 0.1).empty());
}
