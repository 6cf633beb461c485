#include "fascicle/base/error.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/scene/embedded_scenes.hpp"
#include "fascicle/solver/parameters.hpp"
#include "fascicle/solver/soft_body_solver.hpp"
#include "reproduce/experiment_scene.hpp"
#include "reproduce/method_effort.hpp"
#include "reproduce/published.hpp"
#include "reproduce/reproduce.hpp"
#include "reproduce/sweep.hpp"
#include "support/data_dir.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>
#include <numbers>
#include <set>

using namespace fascicle;
using namespace fascicle::reproduce;

TEST_CASE("reproduce: keys of experiments are unique and stand-ins exist", "[reproduce][unit]") {
    std::set<std::string> keys, scenes;
    for (const EmbeddedSceneInfo& scene : embedded_scenes())
        scenes.insert(scene.name);
    for (const Experiment& e : experiments()) {
        INFO(e.key);
        CHECK(keys.insert(e.key).second);
        CHECK_FALSE((e.title.empty() || e.muscle.empty()));
        CHECK(e.figures.empty() == is_sweep(e.motion));
        CHECK((e.stand_in.empty() || scenes.contains(e.stand_in)));
        CHECK((e.published.empty() || !published_marks(e.published).empty()));
        CHECK(find_experiment(e.key) == &e);
        CHECK((e.stand_in.empty() && e.muscle_file.empty()) == false);
    }
    CHECK(find_experiment("no such") == nullptr);
    const std::vector<std::string> parts = part_keys();
    CHECK(std::set<std::string>(parts.begin(), parts.end()).size() == parts.size());
}

TEST_CASE("reproduce: every figure of the paper belongs to an experiment", "[reproduce][unit]") {
    std::string all = ", 22, 9,"; // line segments and Kukacka's fibres: plots of the hip experiments
    for (const Experiment& e : experiments())
        all += " " + e.figures + ",";
    for (int figure = 1; figure <= 22; ++figure)
        CHECK(all.find(" " + std::to_string(figure) + ",") != std::string::npos);
}

TEST_CASE("reproduce: every method of the registry runs every experiment for all", "[reproduce][unit]") {
    for (const Experiment& e : experiments()) {
        const std::vector<std::string> methods = methods_of(e, {});
        if (e.methods == MethodChoice::all)
            CHECK(methods.size() == solver_methods().size());
        else
            CHECK(methods.size() == 1);
        CHECK(methods_of(e, {"no such"}).empty());
    }
    for (const SolverMethod& method : solver_methods()) {
        INFO(method.name);
        CHECK(300 % frames_of(method.name, false) == 0);
        CHECK(frames_of(method.name, false) % 6 == 0); // surfaces are kept at every sixth
        CHECK(frames_of(method.name, true) % 6 == 0);
    }
    CHECK(frames_of("a method of tomorrow", false) == 300);
}

TEST_CASE("reproduce: the short form changes parameters of the method alone", "[reproduce][unit]") {
    for (const SolverMethod& method : solver_methods()) {
        ParamSet given = default_parameters();
        set_method(given, method.name);
        ParamSet coarse = given;
        set_effort(coarse, "squish-box", method.name, true);
        INFO(method.name);
        for (const ParamRow& row : given.table().rows())
            if (coarse.text(row.key) != given.text(row.key))
                CHECK(row.key.starts_with(method.name + "."));
    }
    ParamSet fem = default_parameters();
    set_method(fem, "fem");
    const double spacing = fem.get("fem.spacing_mm");
    set_effort(fem, "iliacus", "fem", true);
    CHECK(fem.get("fem.spacing_mm") > 2 * spacing);
}

TEST_CASE("reproduce: a motion through rest goes on to the other side", "[reproduce][unit]") {
    const Hinge hinge{Vec3(1, 2, 3), Vec3::UnitZ()};
    const Timeline motion = through_rest(make_hinge_timeline(hinge, 0.5, {100, 100, 100}, 2, {1}), -0.4);
    CHECK(motion.last_frame == 300);
    const Vec3 p(5, 6, 7);
    const std::pair<int, double> wanted[] = {{0, 0.0},   {50, 0.25},  {100, 0.5}, {150, 0.25},
                                             {200, 0.0}, {250, -0.2}, {300, -0.4}};
    for (const auto& [frame, angle] : wanted) {
        INFO(frame);
        CHECK(motion.angle_rad(frame) == Approx(angle).margin(1e-12));
        const Vec3 turned = Eigen::AngleAxisd(angle, Vec3::UnitZ()) * (p - hinge.centre) + hinge.centre;
        CHECK((motion.bone_pose(1, frame).apply(p) - turned).norm() < 1e-9);
        CHECK((motion.bone_pose(0, frame).apply(p) - p).norm() == 0);
    }
}

TEST_CASE("reproduce: adduction brings the thigh inwards, internal rotation its front", "[reproduce][data]") {
    FASCICLE_NEED_DATA(folder);
    const DataFiles data(folder);
    const Vec3 centre = find_experiment("iliacus")->centre;
    // The right thigh: down is -z, forwards -y, inwards (to the left) +x.
    const auto shift = [&](const char* key, int frame, const Vec3& away) {
        const Experiment& e = *find_experiment(key);
        const ExperimentScene made = make_experiment_scene(e, data, 1);
        REQUIRE(made.real);
        const Timeline& motion = made.scene.timeline;
        const double coordinate =
            motion.angle_rad(frame) * 180 / std::numbers::pi + sweep_turn(e.motion).rest_deg;
        CHECK(coordinate == Approx((frame == 100 ? 1 : -1) * sweep_turn(e.motion).to_deg));
        CHECK(motion.hinge->axis.norm() == Approx(1));
        int bone = 0;
        while (!motion.moves(bone))
            ++bone;
        return motion.bone_pose(bone, frame).apply(centre + 300 * away).x() - centre.x();
    };
    CHECK(shift("iliacus-adduction", 100, -Vec3::UnitZ()) > 150);
    CHECK(shift("iliacus-adduction", 300, -Vec3::UnitZ()) < -150);
    CHECK(shift("iliacus-rotation", 100, -Vec3::UnitY()) > 100);
    CHECK(shift("iliacus-rotation", 300, -Vec3::UnitY()) < -100);
}

TEST_CASE("reproduce: files are found by name in sub-folders, the nearest first", "[reproduce][unit]") {
    const test::TempDir dir;
    write_file(dir.path() / "deep" / "er" / "iliacus.vtk", "far");
    write_file(dir.path() / "b" / "iliacus.vtk", "near");
    write_file(dir.path() / ".hidden" / "femur.vtk", "hidden");
    const DataFiles files(dir.path());
    REQUIRE(files.find("iliacus.vtk"));
    CHECK(*files.find("iliacus.vtk") == dir.path() / "b" / "iliacus.vtk");
    CHECK_FALSE(files.find("femur.vtk"));
    CHECK_FALSE(DataFiles().find("iliacus.vtk"));
    CHECK_THROWS_AS(DataFiles(dir.path() / "nowhere"), Error);
}

TEST_CASE("reproduce: without data a stand-in of one muscle, or the missing files by name",
          "[reproduce][unit]") {
    const ExperimentScene iliacus = make_experiment_scene(*find_experiment("iliacus"), {}, 1);
    CHECK_FALSE(iliacus.real);
    REQUIRE(iliacus.scene.muscles.size() == 1);
    CHECK(iliacus.scene.muscles[0].name == "iliacus");
    CHECK(iliacus.scene.parameters.get_choice("fibres.method") == "kukacka");
    const ExperimentScene medius = make_experiment_scene(*find_experiment("gluteus_medius"), {}, 1);
    CHECK(medius.missing == "not in the data: gluteus_medius.vtk, pelvis.obj, femur.vtk");
}

TEST_CASE("reproduce: a motion in fewer frames goes the same way", "[reproduce][unit]") {
    const Timeline full = make_hinge_timeline({Vec3(1, 2, 3), Vec3::UnitX()}, -1.0, {100, 100, 100}, 2, {1});
    const Timeline short_one = in_frames(full, 30);
    CHECK(short_one.last_frame == 30);
    for (int k = 0; k <= 30; ++k) {
        CHECK(short_one.angle_rad(k) == Approx(full.angle_rad(10 * k)).margin(1e-12));
        const Vec3 p(5, 6, 7);
        CHECK((short_one.bone_pose(1, k).apply(p) - full.bone_pose(1, 10 * k).apply(p)).norm() < 1e-9);
    }
    CHECK(in_frames(full, 300).angle_rad(50) == full.angle_rad(50));
}
