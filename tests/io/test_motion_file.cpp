#include "fascicle/base/error.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/load_scene.hpp"
#include "fascicle/io/motion_file.hpp"
#include "fascicle/io/project_file.hpp"
#include "fascicle/scene/embedded_scenes.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>
#include <numbers>
#include <random>

using namespace fascicle;
using Catch::Matchers::Contains;

namespace {

Scene two_bones(LengthUnit unit = LengthUnit::millimetre) {
    Scene scene;
    scene.unit = unit;
    scene.bones = {{"pelvis", nullptr, {}}, {"femur", nullptr, {}}};
    return scene;
}

Timeline read(const std::string& text, const Scene& scene = two_bones()) {
    return read_motion(text, "m.csv", scene);
}

void fails(const std::string& text, const std::string& words) {
    INFO(text);
    try {
        read(text);
        FAIL("no error; expected: " << words);
    } catch (const Error& error) {
        CHECK_THAT(error.what(), Contains(words));
        CHECK(std::string(error.what()).find('\n') == std::string::npos);
        CHECK(error.kind() == ErrorKind::failed);
    }
}

const std::string matrix = "frame,bone,m00,m01,m02,m03,m10,m11,m12,m13,m20,m21,m22,m23\n";
const std::string turns = "frame,bone,cx,cy,cz,ax,ay,az,angle_deg\n";

double difference(const Pose& a, const Pose& b) {
    return (a.rotation - b.rotation).norm() + (a.translation - b.translation).norm();
}

Pose turn(const Vec3& centre, const Vec3& axis, double degrees) {
    return rotation_about(centre, axis, degrees * std::numbers::pi / 180);
}

} // namespace

TEST_CASE("motion file: transforms from rest", "[io][motion_file]") {
    const Timeline t = read(matrix + "10,femur,0,-1,0,5,1,0,0,6,0,0,1,7\n20,femur,1,0,0,0,0,1,0,0,0,0,1,0\n");
    CHECK(t.last_frame == 20);
    CHECK_FALSE(t.hinge);
    CHECK(t.angle_rad(10) == 0);
    CHECK(t.bone_pose(0, 10).is_identity());
    CHECK_FALSE(t.bone_tracks[0].moves());
    CHECK(t.bone_tracks[1].moves());
    CHECK(t.bone_pose(1, 0).is_identity());
    CHECK(t.bone_pose(1, 10).apply(Vec3(1, 2, 3)) == Vec3(3, 7, 10));
    CHECK(difference(t.bone_pose(1, 5), screw_between(Pose{}, t.bone_pose(1, 10), 0.5)) < 1e-15);
    CHECK(t.bone_pose(1, 20).is_identity());
}

TEST_CASE("motion file: rotations are made orthonormal, exact ones stay as they are", "[io][motion_file]") {
    const Timeline t = read(matrix + "10,femur,0.8660254,-0.5,0,0,0.5,0.8660254,0,0,0,0,1,0\n");
    const Mat3 r = t.bone_pose(1, 10).rotation;
    CHECK((r * r.transpose() - Mat3::Identity()).norm() < 1e-15);
    CHECK((r - turn(Vec3::Zero(), Vec3::UnitZ(), 30).rotation).norm() < 1e-7);
    const Timeline exact = read(matrix + "10,femur,0.6,-0.8,0,0,0.8,0.6,0,0,0,0,1,0\n");
    CHECK(exact.bone_pose(1, 10).rotation(0, 0) == 0.6);
}

TEST_CASE("motion file: turns of one frame compose in the order of the rows", "[io][motion_file]") {
    const Timeline t = read(turns + "50,femur,1,2,3,2,0,0,-40\n50,femur,1,2,3,0,1,0,25\n"
                                    "100,femur,1,2,3,1,0,0,0\n100,femur,1,2,3,0,1,0,0\n");
    const Vec3 c(1, 2, 3);
    CHECK(difference(t.bone_pose(1, 50), turn(c, Vec3::UnitY(), 25).after(turn(c, Vec3::UnitX(), -40))) <
          1e-12);
    CHECK(t.bone_pose(1, 100).is_identity());
    CHECK_FALSE(t.hinge);
    CHECK(t.angle_rad(50) == 0);
}

TEST_CASE("motion file: one turn about one axis is a joint angle", "[io][motion_file]") {
    const Timeline t = read(turns + "100,femur,1,2,3,0,0,2,540\n200,femur,1,2,3,0,0,1,0\n");
    REQUIRE(t.hinge);
    CHECK(t.hinge->centre == Vec3(1, 2, 3));
    CHECK(t.hinge->axis == Vec3::UnitZ());
    CHECK(t.angle_rad(50) == Approx(1.5 * std::numbers::pi));
    CHECK(difference(t.bone_pose(1, 50), turn(Vec3(1, 2, 3), Vec3::UnitZ(), 270)) < 1e-9);
    CHECK(difference(t.bone_pose(1, 100), turn(Vec3(1, 2, 3), Vec3::UnitZ(), 180)) < 1e-9);
    CHECK(t.bone_pose(1, 200).is_identity());
    // Two bones that turn alike have it, too; others have none.
    CHECK(read(turns + "9,femur,1,2,3,0,0,1,5\n9,pelvis,1,2,3,0,0,1,5\n").hinge);
    CHECK_FALSE(read(turns + "9,femur,1,2,3,0,0,1,5\n9,pelvis,1,2,3,0,0,1,6\n").hinge);
    CHECK_FALSE(read(turns + "9,femur,1,2,3,0,0,1,5\n20,femur,1,2,3,0,1,1,5\n").hinge);
}

TEST_CASE("motion file: as spreadsheets write it", "[io][motion_file]") {
    const Timeline t = read("\xef\xbb\xbf"
                            "Bone;Frame;ax;ay;az;angle [deg];cx (mm);cy (mm);cz (mm)\r\n"
                            "femur;10;0;0;1;1,5;1000;0;0\r\n;;;;;;;;\r\n\"femur\";20,5;0;0;1;0;1000;0;0\r\n",
                            two_bones(LengthUnit::metre));
    CHECK(t.last_frame == 21);
    CHECK(difference(t.bone_pose(1, 10), turn(Vec3::UnitX(), Vec3::UnitZ(), 1.5)) < 1e-12);
    CHECK(t.bone_pose(1, 21).is_identity());
}

TEST_CASE("motion file: errors name the line", "[io][motion_file]") {
    const std::string identity = ",1,0,0,0,0,1,0,0,0,0,1,0\n";
    fails("", "m.csv: the file is empty");
    fails("bone,m00\n", "m.csv, line 1: the header lacks column 'frame'");
    fails("frame,bone,x\n",
          "line 1: the header has neither m00 nor angle_deg; expected a header row frame,bone,m00");
    fails("frame,bone,m00,m01\n", "line 1: the header lacks column 'm02'");
    fails("frame,bone,m00,angle_deg\n", "both m00 and angle_deg");
    fails("frame,bone,cx,cy,ax,ay,az,angle_deg\n", "the header lacks column 'cz'");
    fails("frame,bone,cx_mm,cy,cz,ax,ay,az,angle_deg\n", "the header lacks column 'cy_mm'");
    fails(matrix, "m.csv: the table has no rows");
    fails(matrix + "0,femur" + identity, "m.csv: the motion ends at frame 0");
    fails(matrix + "1,femr" + identity,
          "line 2: there is no bone 'femr'; did you mean 'femur'?; expected one of pelvis, femur");
    fails(matrix + "1," + identity, "line 2: no bone");
    fails(matrix + "-1,femur" + identity, "line 2: frame is '-1'; expected a number from 0 to 3000000");
    fails(matrix + "3000001,femur" + identity, "line 2: frame is");
    fails(matrix + "nan,femur" + identity, "line 2: got 'nan' in column 'frame'");
    fails(matrix + "2,femur" + identity + "1,pelvis" + identity + "1,femur" + identity,
          "line 4: frame 1 of bone 'femur' comes after frame 2; expected ascending frames");
    fails(matrix + "2,femur" + identity + "2,femur" + identity,
          "line 3: frame 2 of bone 'femur' is there twice");
    fails(matrix + "1,femur,1,0,0,0,0,1,0,inf,0,0,1,0\n", "line 2: got 'inf' in column 'm13'");
    fails(matrix + "1,femur,1,0,0,0,0,1,0,0,0,0,1\n", "line 2: got '' in column 'm23'");
    fails(matrix + "1,femur,1.00001,0,0,0,0,1,0,0,0,0,1,0\n", "line 2: the 3x3 part is no rotation");
    fails(matrix + "1,femur,1e300,0,0,0,0,1,0,0,0,0,1,0\n", "no rotation");
    fails(matrix + "1,femur,-1,0,0,0,0,1,0,0,0,0,1,0\n", "line 2: the 3x3 part is a reflection");
    fails(matrix + "0,femur,1,0,0,0.1,0,1,0,0,0,0,1,0\n2,femur" + identity,
          "line 2: bone 'femur' is not at rest in frame 0");
    fails(matrix + "\n9,femur,-1,0,0,0,0,-1,0,0,0,0,1,0\n",
          "line 3: bone 'femur' turns by 180 degrees or more since");
    fails(turns + "5,femur,0,0,0,0,0,0,1\n", "line 2: the axis has no direction");
    fails(turns + "5,femur,0,0,0,1,0,0,3601\n", "line 2: the angle is 3601; expected -3600 to 3600 degrees");
    fails(turns + "5,femur,0,0,0,1,0,0,10\n6,femur,0,0,0,1,0,0,190\n",
          "line 3: bone 'femur' turns by 180 degrees or more a frame");
    fails(turns + "5,femur,0,0,0,1,0,0,200\n9,femur,0,0,0,0,1,0,20\n", "line 3: bone 'femur' turns by 180");
    fails(turns + "5,femur,1.7e308,1.7e308,0,0,0,1,170\n", "line 2: the motion of bone 'femur' overflows");
}

TEST_CASE("motion file: damaged files end in a timeline or an Error of one line", "[io][motion_file]") {
    const std::string good = turns +
                             "5,femur,0,0,0,1,0,0,10\n5,femur,0,0,0,0,1,0,10\n20,femur,0,0,0,1,0,0,90\n"
                             "30,pelvis,1e3,-2,.5,0,0,1,-700\n";
    std::mt19937 random(3);
    for (int round = 0; round < 2000; ++round) {
        std::string text = good;
        for (auto n = 1 + random() % 3; n > 0; --n) {
            const std::size_t at = random() % text.size();
            if (random() % 2 == 0)
                text[at] = "0123456789-+.,;e\n\"x"[random() % 19];
            else
                text.erase(at, random() % 4);
        }
        try {
            const int last = read(text).last_frame; // no CHECK around it: that would catch the Error
            CHECK(last >= 1);
        } catch (const Error& error) {
            CHECK(std::string(error.what()).find('\n') == std::string::npos);
        }
    }
}

TEST_CASE("a motion file replaces the motion of any source, and a project keeps it", "[io][motion_file]") {
    const test::TempDir dir;
    write_file(dir.path() / "m.csv",
               turns + "10,plate_top,0,0,0,0,1,0,400\n20,plate_bottom,0,0,0,1,0,0,10\n");
    SceneRequest request;
    request.embedded = "squish-box";
    request.motion = dir.path() / "m.csv";
    const LoadedScene loaded = load_scene(request);
    CHECK(loaded.scene.timeline.last_frame == 20);
    CHECK(loaded.scene.motion_source.path == request.motion.string());
    CHECK_THAT(loaded.notes.back(), Contains("m.csv: moves plate_top, plate_bottom, 20 frames"));

    write_project_file(dir.path() / "a.fascicle", loaded.scene);
    const Timeline again = read_project_file(dir.path() / "a.fascicle").scene.timeline;
    for (const double frame : {0.0, 3.3, 10.0, 20.0})
        for (const int bone : {0, 1})
            CHECK(difference(again.bone_pose(bone, frame), loaded.scene.timeline.bone_pose(bone, frame)) ==
                  0);

    request.phases = Phases{1, 1, 1};
    CHECK_THROWS_WITH(load_scene(request), Contains("--phases"));
}
