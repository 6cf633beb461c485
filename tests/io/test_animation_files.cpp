// Every format of animations: what is written comes back, frame by frame.
#include "fascicle/base/error.hpp"
#include "fascicle/io/animation_file.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "fascicle/io/mesh_hints.hpp"
#include "support/growth.hpp"
#include "support/moving_bodies.hpp"
#include "support/temp_dir.hpp"

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::test;
namespace fs = std::filesystem;

namespace {

/// Half a step between two floats at this size, for the three coordinates.
double float_rounding(double size) {
    return size * 0x1p-24 * 1.7321;
}

/// Bodies in metres, y up, as glTF has them.
AnimatedBody in_metres(const AnimatedBody& body, std::size_t frames) {
    AnimatedBody out = body;
    out.poses.clear();
    out.points = [body](std::size_t k, Points& points) {
        points_in_frame(body, k, points);
        for (Vec3& p : points)
            p = Vec3(p.x(), p.z(), -p.y()) / 1000;
    };
    (void)frames;
    return out;
}

fs::path written(const TempDir& folder, const char* key, const Animation& animation,
                 const AnimationOptions& options = {}) {
    const AnimationFormat* format = find_animation_format(key);
    REQUIRE(format != nullptr);
    const fs::path target = folder.path() / (std::string("out") + (format->folder ? "" : format->extension));
    if (format->folder)
        fs::create_directories(target);
    format->write(target, animation, options, {});
    return target;
}

} // namespace

TEST_CASE("A binary glTF gives back every frame of every body", "[io][animation][unit]") {
    const TempDir folder;
    const Animation wanted = moving_bodies(13, 5, 2);
    const Animation found = read_animation(written(folder, "glb", wanted));
    CHECK(found.name == "two bones");
    CHECK(found.up == 'y');
    CHECK(found.millimetres_per_unit == 1000);
    CHECK(found.frames == wanted.frames);
    REQUIRE(found.seconds.size() == 13);
    for (std::size_t k = 0; k < 13; ++k) // the first frame is at time 0
        CHECK(found.seconds[k] == Approx(wanted.seconds[k] - wanted.seconds[0]).margin(1e-9));
    REQUIRE(found.bodies.size() == 4);
    CHECK(found.bodies[0].name == wanted.bodies[0].name);
    CHECK(found.bodies[2].name == "pelvis");
    CHECK(found.bodies[3].name == "pelvis 2");
    for (std::size_t b = 0; b < 4; ++b) {
        INFO(b);
        CHECK(found.bodies[b].kind == wanted.bodies[b].kind);
        CHECK(found.bodies[b].triangles == wanted.bodies[b].triangles);
        CHECK(found.bodies[b].lines == wanted.bodies[b].lines);
        // A base and a difference are each rounded; a rigid body has four rounded numbers of a turn over points 0.5 m away.
        const double allowed = b < 2 ? 2 * float_rounding(1) : 8 * float_rounding(1);
        CHECK(largest_difference(found.bodies[b], in_metres(wanted.bodies[b], 13), 13) < allowed);
    }
}

TEST_CASE("A glTF of a long run has shapes of evenly chosen frames, and bones in all of them",
          "[io][animation][unit]") {
    CHECK(spread_frames(1, 64) == std::vector<std::size_t>{0});
    CHECK(spread_frames(65, 64).size() == 65);
    CHECK(spread_frames(66, 64).size() == 34); // every other one
    CHECK(spread_frames(301, 64).size() == 61);
    CHECK(spread_frames(12, 3) == std::vector<std::size_t>{0, 4, 8, 11});
    const TempDir folder;
    const Animation wanted = moving_bodies(12);
    const Animation found = read_animation(written(folder, "glb", wanted, {3}));
    REQUIRE(found.frame_count() == 12); // of the bone
    CHECK(largest_difference(found.bodies[3], in_metres(wanted.bodies[3], 12), 12) < 8 * float_rounding(1));
    Points shape, exact, first, last;
    for (const std::size_t k : {0, 4, 8, 11}) {
        points_in_frame(found.bodies[0], k, shape);
        points_in_frame(in_metres(wanted.bodies[0], 12), k, exact);
        CHECK((shape[9] - exact[9]).norm() < 2 * float_rounding(1));
    }
    // Between two shapes the muscle is blended.
    points_in_frame(found.bodies[0], 6, shape);
    points_in_frame(found.bodies[0], 4, first);
    points_in_frame(found.bodies[0], 8, last);
    CHECK((shape[9] - 0.5 * (first[9] + last[9])).norm() < 4 * float_rounding(1));
}

TEST_CASE("A USD text gives back every frame to the rounding of its floats", "[io][animation][unit]") {
    const TempDir folder;
    Animation wanted = moving_bodies(9, 0, 3);
    wanted.provenance = "{\"program\": \"a \\\"quoted\\\" name\"}";
    for (const char up : {'z', 'y'}) {
        wanted.up = up;
        const fs::path file = written(folder, "usda", wanted);
        const Animation found = read_animation(file);
        CHECK(found.name == wanted.name);
        CHECK(found.up == up);
        CHECK(found.millimetres_per_unit == Approx(1).epsilon(1e-12));
        CHECK(found.provenance == wanted.provenance);
        CHECK(found.frames == wanted.frames);
        CHECK(found.seconds[8] == Approx(0.24).epsilon(1e-12));
        REQUIRE(found.bodies.size() == 4);
        for (std::size_t b = 0; b < 4; ++b) {
            INFO(b);
            CHECK(found.bodies[b].name == wanted.bodies[b].name); // not made unique: the path is
            CHECK(found.bodies[b].triangles == wanted.bodies[b].triangles);
            CHECK(found.bodies[b].lines == wanted.bodies[b].lines);
            CHECK(largest_difference(found.bodies[b], wanted.bodies[b], 9) < float_rounding(1024));
        }
        // Turns are doubles: a bone's frames are as exact as its rest, whose corners are whole numbers.
        CHECK(largest_difference(found.bodies[3], wanted.bodies[3], 9) < 1e-9);
        const std::string text = read_file(file);
        CHECK(text.find("timeCodesPerSecond = 100\n") != std::string::npos);
        CHECK(text.find("endTimeCode = 24\n") != std::string::npos);
        CHECK(text.find("def Xform \"pelvis_2\"") != std::string::npos);
        CHECK(text.find("def Mesh \"glut__us__max__1\"") != std::string::npos);
        CHECK(text.find("float3[] extent.timeSamples") != std::string::npos);
    }
}

TEST_CASE("A sequence of OBJ files and series for ParaView give back the same numbers",
          "[io][animation][unit]") {
    const TempDir folder;
    const Animation wanted = moving_bodies(4, 8, 4);
    const fs::path objs = written(folder, "obj", wanted);
    const Animation found = read_animation(objs / "two bones_0012.obj"); // any of them
    CHECK(found.name == "two bones");
    CHECK(found.frames == wanted.frames);
    CHECK(found.seconds == wanted.seconds);
    CHECK(found.millimetres_per_unit == 1);
    REQUIRE(found.bodies.size() == 4);
    for (std::size_t b = 0; b < 4; ++b) {
        CHECK(found.bodies[b].triangles == wanted.bodies[b].triangles);
        CHECK(found.bodies[b].lines == wanted.bodies[b].lines);
        CHECK(largest_difference(found.bodies[b], wanted.bodies[b], 4) == 0);
    }
    CHECK(found.bodies[3].name == "pelvis_2");
    CHECK(read_mesh_file(objs / "two bones_0008.obj").mesh.vertex_count() == 18 + 6 + 16); // as a mesh, too

    const fs::path series = written(folder, "pvd", wanted);
    const char* names[] = {"glut\xC3\xA9us \"max\"_1", "fibres", "pelvis", "pelvis_2"};
    for (std::size_t b = 0; b < 4; ++b) {
        const Animation one = read_animation(series / (std::string(names[b]) + ".pvd"));
        CHECK(one.frames == wanted.frames);
        CHECK(one.seconds == wanted.seconds);
        REQUIRE(one.bodies.size() == 1);
        CHECK(one.bodies[0].triangles == wanted.bodies[b].triangles);
        CHECK(one.bodies[0].lines == wanted.bodies[b].lines);
        CHECK(largest_difference(one.bodies[0], wanted.bodies[b], 4) == 0);
    }
}

TEST_CASE("Point caches give back every frame to the rounding of their floats", "[io][animation][unit]") {
    const char* names[] = {"glut\xC3\xA9us \"max\"_1", "fibres", "pelvis", "pelvis_2"};
    const Animation wanted = moving_bodies(7, 10, 5);
    for (const char* key : {"pc2", "mdd"}) {
        const TempDir folder;
        const fs::path caches = written(folder, key, wanted);
        CHECK_FALSE(
            fs::exists(caches / (std::string("pelvis.") + key))); // it stands still: its OBJ is enough
        for (const std::size_t b : {0, 1, 3}) {
            INFO(key << ' ' << b);
            const fs::path file = caches / (std::string(names[b]) + "." + key);
            const Animation found = read_animation(file);
            CHECK(found.frames == wanted.frames);
            for (std::size_t k = 0; k < 7; ++k)
                CHECK(found.seconds[k] == Approx(wanted.seconds[k]).epsilon(1e-6));
            REQUIRE(found.bodies.size() == 1);
            CHECK(found.bodies[0].triangles == wanted.bodies[b].triangles);
            CHECK(found.bodies[0].lines == wanted.bodies[b].lines);
            CHECK(largest_difference(found.bodies[0], wanted.bodies[b], 7) < float_rounding(1024));
            CHECK(fs::file_size(file) ==
                  (std::string(key) == "pc2" ? 32 : 8 + 4 * 7) + 7 * 12 * wanted.bodies[b].rest.size());
        }
        Animation uneven = wanted;
        uneven.frames.back() += 1;
        CHECK_THROWS_WITH(find_animation_format(key)->write(caches, uneven, {}, {}),
                          Catch::Contains("equal distances"));
    }
}

TEST_CASE("A cache without its OBJ, or with another one, is refused", "[io][animation][unit]") {
    const TempDir folder;
    const fs::path caches = written(folder, "pc2", moving_bodies(3));
    fs::copy_file(caches / "fibres.pc2", caches / "pelvis.pc2");
    CHECK_THROWS_WITH(read_animation(caches / "pelvis.pc2"),
                      Catch::Contains("6 points, but pelvis.obj has 8"));
    fs::remove(caches / "fibres.obj");
    CHECK_THROWS_WITH(read_animation(caches / "fibres.pc2"), Catch::Contains("no fibres.obj beside it"));
}

TEST_CASE("A glTF or USD can be opened as a mesh: its first frame", "[io][animation][unit]") {
    const TempDir folder;
    const Animation animation = moving_bodies(3);
    for (const char* key : {"glb", "usda"}) {
        fs::path file = written(folder, key, animation);
        fs::rename(file, file.parent_path() / "wrong.stl"); // by content
        const MeshFile mesh = read_mesh_file(file.parent_path() / "wrong.stl");
        CHECK(mesh.mesh.triangle_count() == 32 + 12 + 12);
        CHECK(mesh.lines.lines.size() == 2);
        CHECK(read_mesh_hints(file.parent_path() / "wrong.stl").millimetres ==
              Approx(std::string(key) == "glb" ? 1000 : 1));
        Points first;
        points_in_frame(std::string(key) == "glb" ? in_metres(animation.bodies[0], 3) : animation.bodies[0],
                        0, first);
        CHECK((mesh.mesh.positions[11] - first[11]).norm() < 1e-4);
        CHECK(std::any_of(mesh.notes.begin(), mesh.notes.end(), [](const std::string& note) {
            return note.find("first of 3 frames") != std::string::npos;
        }));
    }
}

TEST_CASE("An animation that stands still is written without motion", "[io][animation][unit]") {
    const TempDir folder;
    const Animation wanted = moving_bodies(1);
    for (const char* key : {"glb", "usda"}) {
        const Animation found = read_animation(written(folder, key, wanted));
        CHECK(found.frame_count() == 1);
        CHECK(found.bodies.size() == 4);
    }
    Animation empty;
    empty.frames = {0}, empty.seconds = {0};
    CHECK_THROWS_WITH(written(folder, "glb", empty), Catch::Contains("nothing to write"));
}

TEST_CASE("Cancelling the writing of an animation leaves nothing", "[io][animation][unit]") {
    const Animation animation = moving_bodies(20);
    for (const AnimationFormat& format : animation_formats()) {
        if (format.folder)
            continue; // what gathers the files of a folder takes care of it
        const TempDir folder;
        std::atomic<bool> stop{false};
        JobControl control;
        control.cancel = &stop;
        control.report = [&](std::string_view, double done) { stop = stop || done > 0.3; };
        CHECK_THROWS_AS(format.write(folder.path() / "x", animation, {}, control), Cancelled);
        CHECK(fs::is_empty(folder.path()));
    }
}

TEST_CASE("Names are made different, safe for files, and identifiers", "[io][animation][unit]") {
    CHECK(unique_names({"a", "A", "", "a 2"}) == std::vector<std::string>{"a", "A 2", "body", "a 2 2"});
    CHECK(unique_file_names({"../x", "x/y", "x_y", ".hidden"}) ==
          std::vector<std::string>{"_.._x", "x_y", "x_y_2", "_.hidden"});
    CHECK(unique_identifiers({"1 b", "m\xC3\xBCskel", "m??skel"}) ==
          std::vector<std::string>{"_1_b", "m__skel", "m__skel_2"});
}

TEST_CASE("Very many bodies of one name get names quickly", "[io][animation][unit]") {
    CHECK(unique_identifiers({"b", "b_2", "B", "b", "b_3"}) ==
          std::vector<std::string>{"b", "b_2", "B_3", "b_4", "b_3_2"});
    CHECK(growth(3000, [](int n) {
              const auto names =
                  unique_identifiers(std::vector<std::string>(static_cast<std::size_t>(n), "body"));
              CHECK(names.back() == "body_" + std::to_string(n));
          }) < 9);
}
