#include "fascicle/scene/embedded_scenes.hpp"

#include "../geometry/surface_checks.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/base/state_hash.hpp"
#include "support/data_dir.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <fstream>
#include <string>

using namespace fascicle;

namespace {

/// Points and triangles of a legacy ASCII VTK file that holds nothing but them.
TriMesh read_plain_vtk(const std::filesystem::path& path) {
    std::ifstream in(path);
    std::string word;
    TriMesh mesh;
    int count = 0, indices = 0;
    while (in >> word && word != "POINTS") {
    }
    in >> count >> word;
    mesh.positions.resize(static_cast<std::size_t>(count));
    for (Vec3& p : mesh.positions)
        in >> p.x() >> p.y() >> p.z();
    in >> word >> count >> indices;
    mesh.triangles.resize(static_cast<std::size_t>(count));
    for (Tri& t : mesh.triangles)
        in >> indices >> t[0] >> t[1] >> t[2];
    return mesh;
}

/// Corners of the triangles rounded to 1e-2 (the file has six digits), each triangle turned so that its smallest corner comes first, sorted.
std::vector<std::array<std::array<long, 3>, 3>> canonical(const TriMesh& mesh) {
    std::vector<std::array<std::array<long, 3>, 3>> list;
    for (const Tri& t : mesh.triangles) {
        std::array<std::array<long, 3>, 3> c{};
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t a = 0; a < 3; ++a)
                c[k][a] = std::lround(
                    1e2 * mesh.positions[static_cast<std::size_t>(t[k])][static_cast<Eigen::Index>(a)]);
        std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
        list.push_back(c);
    }
    std::sort(list.begin(), list.end());
    return list;
}

void check_scene_is_sound(const Scene& scene) {
    const auto check_mesh = [](const std::string& name, const TriMesh& mesh) {
        INFO(name);
        const auto r = test::report(mesh);
        CHECK(r.closed);
        CHECK(r.one_fan);
        CHECK(r.volume > 0.0);
    };
    for (const Bone& bone : scene.bones)
        check_mesh(bone.name, *bone.mesh);
    for (const Muscle& muscle : scene.muscles) {
        check_mesh(muscle.name, *muscle.mesh);
        std::set<int> taken;
        for (const Attachment& a : muscle.attachments) {
            CHECK(a.bone >= 0);
            CHECK(a.bone < static_cast<int>(scene.bones.size()));
            CHECK(!a.vertices.empty());
            CHECK(std::is_sorted(a.vertices.begin(), a.vertices.end()));
            for (const int v : a.vertices) {
                CHECK(v < muscle.mesh->vertex_count());
                CHECK(taken.insert(v).second);
            }
        }
    }
}

} // namespace

TEST_CASE("every embedded scene is made under its name, sound, and unknown names list the known ones",
          "[scene][embedded]") {
    REQUIRE(embedded_scenes().size() >= 2);
    for (const EmbeddedSceneInfo& info : embedded_scenes()) {
        INFO(info.name);
        const Scene scene = make_embedded_scene(info.name, 2);
        CHECK(scene.name == info.name);
        CHECK(scene.embedded_name == info.name);
        CHECK(!info.line.empty());
        CHECK(scene.timeline.last_frame == 300);
        check_scene_is_sound(scene);
    }
    try {
        make_embedded_scene("nowhere");
        FAIL("no error");
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::usage);
        CHECK(std::string(error.what()).find("squish-box, cylinder") != std::string::npos);
    }
}

TEST_CASE("the squish box is the published one", "[scene][embedded][squish_box]") {
    const Scene scene = make_embedded_scene("squish-box");
    const TriMesh& box = *scene.muscles.at(0).mesh;
    CHECK(box.triangle_count() == 5292);
    CHECK(box.vertex_count() == 2648);
    CHECK(test::report(box).volume == Approx(800000.0));
    CHECK(scene.muscles[0].name == "box");
    CHECK(scene.muscles[0].attachments.empty());
    CHECK_FALSE(scene.muscles[0].attach_automatically);
    const int top = scene.bone_index("plate_top"), bottom = scene.bone_index("plate_bottom");
    REQUIRE(top >= 0);
    REQUIRE(bottom >= 0);
    for (const int b : {top, bottom})
        CHECK(scene.bones[static_cast<std::size_t>(b)].mesh->triangle_count() == 12);
    CHECK((scene.timeline.bone_pose(top, 1).translation - Vec3(0, -0.9, 0)).norm() < 1e-9);
    CHECK((scene.timeline.bone_pose(top, 100).translation - Vec3(0, -90, 0)).norm() < 1e-9);
    CHECK((scene.timeline.bone_pose(top, 150).translation - Vec3(0, -45, 0)).norm() < 1e-9);
    CHECK(scene.timeline.bone_pose(top, 200).is_identity());
    CHECK(scene.timeline.bone_pose(bottom, 100).is_identity());
}

TEST_CASE("the squish box has the published triangles", "[scene][embedded][squish_box]") {
    FASCICLE_NEED_DATA(data);
    const Scene scene = make_embedded_scene("squish-box");
    const bool same =
        canonical(*scene.muscles[0].mesh) == canonical(read_plain_vtk(data / "squish-box" / "box.vtk"));
    CHECK(same);
    for (const Bone& plate : scene.bones) {
        const TriMesh published = read_plain_vtk(data / "squish-box" / (plate.name + ".vtk"));
        Eigen::AlignedBox3d ours, theirs;
        for (const Vec3& p : plate.mesh->positions)
            ours.extend(p);
        for (const Vec3& p : published.positions)
            theirs.extend(p);
        CHECK(ours.isApprox(theirs));
    }
}

TEST_CASE("the strap at any angle has the length and moment arm of the closed form",
          "[scene][embedded][cylinder]") {
    const Scene scene = make_embedded_scene("cylinder");
    const Muscle& strap = scene.muscles.at(0);
    const TriMesh& mesh = *strap.mesh;
    CHECK(mesh.triangle_count() == 3832);
    const auto r = test::report(mesh);
    CHECK(r.min_angle_deg > 30.0);
    CHECK(r.volume ==
          Approx(cylinder_path_length(0.0) * CylinderScene::thickness * CylinderScene::width).epsilon(1e-3));
    CHECK(cylinder_path_length(0.3, 1.0) - cylinder_path_length(0.2, 1.0) ==
          Approx(0.1 * cylinder_moment_arm(1.0)));

    // The chain of edges along the middle of the side of the strap (x = width / 2, no offset), walked from the mesh.
    std::vector<Vec3> chain;
    for (const Vec3& p : mesh.positions)
        if (std::abs(p.x() - 0.5 * CylinderScene::width) < 1e-9) {
            const double out =
                p.y() < 0.0 && p.z() < 0.0 ? std::hypot(p.y(), p.z()) : -std::min(p.y(), p.z());
            if (std::abs(out - cylinder_moment_arm()) < 1e-9)
                chain.push_back(p);
        }
    REQUIRE(chain.size() == 73);
    std::sort(chain.begin(), chain.end(),
              [](const Vec3& a, const Vec3& b) { return a.y() - a.z() < b.y() - b.z(); });
    double length = 0.0;
    for (std::size_t i = 0; i + 1 < chain.size(); ++i)
        length += (chain[i + 1] - chain[i]).norm();
    CHECK(length == Approx(cylinder_path_length(0.0)).epsilon(1e-3));

    // Clear of the bones, and attached vertices next to theirs.
    for (const Vec3& p : mesh.positions)
        CHECK(std::hypot(p.y(), p.z()) >= CylinderScene::cylinder_radius + CylinderScene::clearance - 1e-9);
    REQUIRE(strap.attachments.size() == 2);
    CHECK(strap.attachments[0].bone == scene.bone_index("fixed_block"));
    CHECK(strap.attachments[1].bone == scene.bone_index("moving_block"));
    for (const int v : strap.attachments[0].vertices)
        CHECK(mesh.positions[static_cast<std::size_t>(v)].z() >= CylinderScene::straight_length - 10.1);
    for (const int v : strap.attachments[1].vertices)
        CHECK(mesh.positions[static_cast<std::size_t>(v)].y() >= CylinderScene::straight_length - 10.1);
    CHECK(strap.attachments[0].vertices.size() == strap.attachments[1].vertices.size());
}

TEST_CASE("the hinge of the cylinder scene is the cylinder's axis and the blocks stay apart",
          "[scene][embedded][cylinder]") {
    const Scene scene = make_embedded_scene("cylinder");
    REQUIRE(scene.timeline.hinge);
    CHECK(scene.timeline.hinge->centre == Vec3::Zero());
    CHECK(scene.timeline.hinge->axis.normalized() == Vec3::UnitX());
    CHECK(scene.timeline.angle_rad(100) == Approx(CylinderScene::angle_rad));
    const int moving = scene.bone_index("moving_block");
    for (int frame = 0; frame <= 100; frame += 10) {
        const Pose pose = scene.timeline.bone_pose(moving, frame);
        for (const Vec3& p : scene.bones[static_cast<std::size_t>(moving)].mesh->positions) {
            const Vec3 q = pose.apply(p);
            CHECK(std::hypot(q.y(), q.z()) > CylinderScene::cylinder_radius + 1.0);
            CHECK(q.y() > 1.0); // the fixed block is at y < 0
        }
    }
}
