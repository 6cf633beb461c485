#include "editor/driver.hpp"
#include "editor/features.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/document/actions/area_actions.hpp"
#include "fascicle/document/actions/parameter_actions.hpp"
#include "fascicle/io/files.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <thread>

using namespace fascicle;
using namespace fascicle::editor;
using fascicle::test::Driver;

namespace {

LessonPlayer& player(Driver& d) {
    return d.editor().features().lessons;
}

/// Draws until a condition holds; things are made in the background.
template <class Condition>
void wait_for(Driver& d, Condition condition) {
    const auto end =
        std::chrono::steady_clock::now() + std::chrono::seconds(200); // a sanitizer makes scenes slowly
    while (!condition() && std::chrono::steady_clock::now() < end) {
        d.frame();
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    REQUIRE(condition());
}

void begin(Driver& d, const std::string& id) {
    d.click("menu/Lessons");
    d.click("menu/lesson/" + id);
    wait_for(d, [&] { return player(d).active() && player(d).lesson().id == id; });
    d.frame(3);
}

/// A frame of the motion with the muscles' points moved.
template <class Move>
void append(Driver& d, int k, Move move) {
    const RecordingPtr recording = d.run()->recording();
    const Scene& scene = recording->scene();
    if (recording->frame_count() == 0) {
        std::vector<std::vector<Attachment>> attachments;
        std::vector<FibreModelPtr> fibres;
        for (const Muscle& muscle : scene.muscles)
            attachments.push_back(muscle.attachments);
        for (const MuscleFibres& muscle : d.editor().features().fibres.muscles())
            fibres.push_back(muscle.fibres);
        recording->set_attachments(std::move(attachments));
        recording->set_fibres(std::move(fibres));
    }
    auto frame = std::make_shared<Frame>();
    frame->index = k;
    frame->angle_rad = scene.timeline.angle_rad(k);
    for (std::size_t b = 0; b < scene.bones.size(); ++b)
        frame->bone_poses.push_back(scene.timeline.bone_pose(static_cast<int>(b), k));
    for (const Muscle& muscle : scene.muscles) {
        auto points = std::make_shared<Points>(muscle.mesh->positions);
        for (std::size_t i = 0; i < points->size(); ++i)
            move((*points)[i], i);
        frame->muscle_positions.push_back(std::move(points));
    }
    recording->append(std::move(frame));
}

/// Feeds the newest run so that the metric becomes what the lesson waits for.
void bring_about(Driver& d, const LessonCheck& check) {
    d.settle();
    wait_for(d, [&] { return d.editor().features().fibres.current(); });
    REQUIRE(d.run() != nullptr);
    append(d, 0, [](Vec3&, std::size_t) {});
    for (int k = 1; k <= 2; ++k) {
        const double angle = d.run()->recording()->scene().timeline.angle_rad(k);
        append(d, k, [&](Vec3& p, std::size_t i) {
            if (check.key == "volume_ratio")
                p.y() *= 0.3;
            else if (check.key.starts_with("dihedral"))
                p += 4 *
                     Vec3(std::sin(12.9 * double(i)), std::sin(78.2 * double(i)), std::sin(37.7 * double(i)));
            else if (check.key.starts_with("moment_arm"))
                p *= 1 + angle; // longer with the angle
            else if (check.key.starts_with("penetrat"))
                p.x() += 8;
            else
                p *= 1.15;
        });
    }
    d.run()->finish();
    d.frame();
    d.editor().metrics().finish();
    d.frame(3);
}

/// What a person does for one condition.
void fulfil(Driver& d, const LessonCheck& check) {
    if (check.what == "parameter" && !check.is.empty()) {
        d.click("parameter/" + check.key);
        d.click("parameter/" + check.key + "/" + check.is);
    } else if (check.what == "parameter") {
        const Rect slider = d.rect("parameter/" + check.key);
        const float y = (slider.min.y + slider.max.y) / 2;
        d.drag({(slider.min.x + slider.max.x) / 2, y},
               {check.above ? slider.max.x + 20 : slider.min.x - 20, y});
    } else if (check.what == "playhead") {
        const Rect ruler = d.rect("timeline/ruler");
        const float y = (ruler.min.y + ruler.max.y) / 2;
        d.drag({ruler.min.x + ruler.width() * 0.1f, y}, {ruler.min.x + ruler.width() * 0.333f, y});
    } else if (check.what == "run") {
        d.settle();
        d.run()->compute(static_cast<int>(*check.above * d.document().scene().timeline.last_frame) + 3);
        d.frame(3);
    } else if (check.what == "view") {
        REQUIRE(check.key == "colouring");
        d.click("toolbar/colouring");
        for (const view::ColouringRow& row : view::colourings())
            if (check.is == row.key)
                return d.click(std::string("toolbar/colouring/") + row.label);
    } else if (check.what == "metric") {
        bring_about(d, check);
    } else if (check.what == "fibres") {
        if (d.has("fibres/template/parallel"))
            d.click("fibres/template/parallel");
        wait_for(d, [&] { return player(d).done(player(d).step_index()); });
    } else if (check.what == "quiz") {
        const Quiz& quiz = *player(d).quiz();
        d.click("lesson/score"); // nothing painted
        REQUIRE(player(d).last_score());
        CHECK(player(d).last_score()->dice() == 0);
        CHECK(player(d).last_score()->second == Approx(quiz.truth_mm2(d.document().scene())));
        const Scene& scene = d.document().scene();
        const actions::AreaKey key{
            scene.muscle_index(quiz.muscle), quiz.kind, scene.bone_index(quiz.bone), {}};
        std::vector<int> most = quiz.truth.vertices();
        most.resize(most.size() * 2 / 3);
        actions::set_area(d.document(), key, SurfaceRegion(quiz.truth.vertex_count(), most), "Paint");
        d.frame(2);
        d.click("lesson/score");
        CHECK(player(d).last_score()->dice() > 0.5);
        CHECK(player(d).last_score()->dice() < 0.95);
        CHECK(player(d).last_score()->jaccard() < player(d).last_score()->dice());
        CHECK(d.has("lesson/score/bar"));
        CHECK(d.has("viewport/quiz")); // the true area as a line
    }
}

/// A highlighted name, or a locked one without a star, belongs to something that is there.
void check_names(Driver& d) {
    const LessonStep& step = player(d).step();
    for (const std::string& name : step.highlighted) {
        INFO("highlighted " << name);
        CHECK(d.has(name));
        CHECK(d.rect(name).max.x <= 1280);
        CHECK(lock_reason(name).empty());
    }
    for (const std::string& name : step.locked)
        if (name.back() != '*' && !name.starts_with("command/") && !player(d).guard().is_highlighted(name) &&
            !name.starts_with("tree/")) { // the tree may have given way to the lesson
            INFO("locked " << name);
            if (d.state().side_panel == "parameters")
                CHECK(d.has(name));
            CHECK_FALSE(lock_reason(name).empty());
        }
}

void go_through(const std::string& id) {
    INFO(id);
    Driver d;
    d.frame(3);
    d.click("tree/fixed");
    d.click("menu/Lessons");
    d.key(key_escape);
    const EditorState before = d.state();
    begin(d, id);
    CHECK(d.state().layout.show_lesson);
    CHECK(d.document().scene().name == player(d).lesson().title);
    const int count = static_cast<int>(player(d).lesson().steps.size());
    for (int i = 0; i < count; ++i) {
        INFO("step " << i + 1);
        REQUIRE(player(d).step_index() == i);
        d.frame(3);
        check_names(d);
        const std::vector<LessonCheck> checks = player(d).step().checks;
        // What is only waited for may be there already: fibres, a metric of the run of the step before.
        const bool waits =
            !checks.empty() && (checks.back().what == "metric" || checks.back().what == "fibres");
        if (!checks.empty() && !(waits && player(d).done(i))) {
            CHECK_FALSE(player(d).done(i));
            d.click("lesson/next"); // too early
            CHECK(player(d).step_index() == i);
            for (const LessonCheck& check : checks)
                fulfil(d, check);
        }
        d.frame(2);
        REQUIRE(player(d).done(i));
        d.state().playback.position = 0; // scrubbing takes nothing back
        d.frame(2);
        CHECK(player(d).done(i));
        d.click("lesson/next");
    }
    wait_for(d, [&] { return !player(d).active(); });
    d.frame(2);
    CHECK(d.document().scene().name == "small");
    CHECK(d.state().selection == before.selection);
    CHECK(d.state().colouring == before.colouring);
    CHECK(d.state().camera.eye() == before.camera.eye());
    CHECK_FALSE(d.state().layout.show_lesson);
    CHECK(control_guard() == nullptr);
    CHECK(d.has("tree/fixed"));
}

} // namespace

TEST_CASE("There are at least five lessons, each valid and listed", "[editor][lessons]") {
    REQUIRE(built_in_lessons().size() >= 6);
    std::set<std::string> ids;
    for (const Lesson& lesson : built_in_lessons()) {
        INFO(lesson.id);
        CHECK(ids.insert(lesson.id).second);
        CHECK_NOTHROW(check_controls(lesson));
        CHECK(lesson.steps.size() >= 3);
    }
    const std::vector<LessonInfo> list = lessons();
    REQUIRE(list.size() == built_in_lessons().size());
    for (const LessonInfo& lesson : list) {
        CHECK_FALSE(lesson.title.empty());
        CHECK_FALSE(lesson.sentence.empty());
        CHECK(lesson.minutes > 0);
    }
}

TEST_CASE("The lesson on volume, clicked through", "[editor][ui][lessons]") {
    go_through("volume");
}

TEST_CASE("The lesson on local shape, clicked through", "[editor][ui][lessons]") {
    go_through("local-shape");
}

TEST_CASE("The lesson on anisotropy, clicked through", "[editor][ui][lessons]") {
    go_through("anisotropy");
}

TEST_CASE("The lesson on contact, clicked through", "[editor][ui][lessons][slow]") {
    go_through("contact");
}

TEST_CASE("The lesson on moment arms, clicked through", "[editor][ui][lessons]") {
    go_through("moment-arm");
}

TEST_CASE("The quiz, clicked through with two thirds of the true area painted",
          "[editor][ui][lessons][slow]") {
    go_through("quiz");
}

TEST_CASE("A lesson locks all but what it points at, and says so", "[editor][ui][lessons]") {
    Driver d;
    d.frame(3);
    begin(d, "volume");
    d.click("lesson/skip");
    d.click("lesson/skip");
    REQUIRE(player(d).step_index() == 2);
    const double stiffness = d.document().scene().parameters.get("solver.stiffness");
    const Rect slider = d.rect("parameter/solver.stiffness");
    const float y = (slider.min.y + slider.max.y) / 2;
    d.drag({slider.min.x + slider.width() * 0.2f, y}, {slider.max.x, y});
    CHECK(d.document().scene().parameters.get("solver.stiffness") == stiffness);
    CHECK(lock_reason("parameter/solver.stiffness") == "locked by the lesson");
    CHECK(lock_reason("parameter/solver.volume").empty());
    CHECK(lock_reason("parameter/solver.volume/free").empty()); // a choice of what is pointed at
    d.click("parameters/reset_all");
    CHECK(d.document().history().undo_name().find("Reset") == std::string::npos);

    d.click("lesson/back");
    CHECK(player(d).step_index() == 1);
    d.click("lesson/step/2"); // reached before
    CHECK(player(d).step_index() == 2);
    d.click("lesson/step/5"); // not reached
    CHECK(player(d).step_index() == 2);
    d.key(key_left, {.alt = true});
    CHECK(player(d).step_index() == 1);
    d.key(key_right, {.alt = true}); // not done
    CHECK(player(d).step_index() == 1);

    // The ring stands still after a while, so that nothing has to be drawn.
    CHECK(player(d).redraw_after().has_value());
    for (int i = 0; i < 30; ++i)
        d.editor().draw_frame(1280, 800, 0.25);
    CHECK_FALSE(player(d).redraw_after().has_value());
}

TEST_CASE("Leaving a lesson gives back the scene with its history, its view and its finished run",
          "[editor][ui][lessons]") {
    Driver d;
    d.frame(3);
    actions::set_parameter(d.document(), "solver.pressure", 1.2);
    d.settle();
    d.run()->compute(61);
    d.run()->finish();
    d.frame(3);
    d.state().colouring = view::Colouring::strain;
    d.state().playback.position = 12;
    d.state().hidden.insert("fixed");
    const RecordingPtr recording = d.editor().runs().recording();
    begin(d, "volume");
    CHECK(player(d).set_aside() != nullptr);
    CHECK(player(d).set_aside()->dirty());
    CHECK(d.state().hidden.empty());
    CHECK(d.state().bone_opacity == 0.4f); // or a plate hides the box that is squeezed
    begin(d, "local-shape"); // another lesson instead: what was first open is still what comes back
    d.click("lesson/leave");
    wait_for(d, [&] { return !player(d).active(); });
    d.frame(3);
    CHECK(d.document().scene().parameters.get("solver.pressure") == 1.2);
    CHECK(d.document().history().steps().size() == 2);
    CHECK(d.document().dirty());
    CHECK(d.state().colouring == view::Colouring::strain);
    CHECK(d.state().playback.playhead() == 12);
    CHECK_FALSE(d.state().visible("fixed"));
    CHECK(d.state().bone_opacity == 1.0f);
    CHECK(d.editor().runs().recording() == recording);
    CHECK(d.editor().runs().valid_count() == 61);
    CHECK(player(d).set_aside() == nullptr);
}

TEST_CASE("Another scene opened from within a lesson ends it, and unsaved work can be fetched back",
          "[editor][lessons]") {
    Driver d;
    d.frame(3);
    actions::set_parameter(d.document(), "solver.pressure", 1.2);
    d.state().muscle_opacity = 0.7f;
    d.state().wireframe = true;
    d.frame(2);
    begin(d, "volume");
    CHECK(d.state().muscle_opacity == 1.0f);
    CHECK_FALSE(d.state().wireframe);
    d.editor().features().opener.open_scene({test::small_scene(), {}, {}});
    d.frame(3);
    CHECK_FALSE(player(d).active());
    CHECK_FALSE(d.state().layout.show_lesson);
    CHECK(control_guard() == nullptr);
    CHECK(d.state().muscle_opacity == 0.7f); // how things are drawn is the user's again
    CHECK(d.state().bone_opacity == 1.0f);
    CHECK(d.state().wireframe);
    REQUIRE(player(d).set_aside() != nullptr);
    d.editor().run(Command::leave_lesson);
    d.frame(3);
    CHECK(d.document().scene().parameters.get("solver.pressure") == 1.2);
    CHECK(player(d).set_aside() == nullptr);
}

TEST_CASE("A lesson of one's own is checked before anything is opened", "[editor][lessons]") {
    const test::TempDir folder;
    const auto file = folder.path() / "mine.json";
    const auto with = [&](const std::string& step) {
        write_file(
            file,
            "{\"format\": \"fascicle lesson\", \"title\": \"Mine\", \"scene\": \"squish-box\", \"steps\": [{"
            "\"title\": \"One\", \"text\": \"Text\"" +
                step + "}]}");
    };
    Driver d;
    d.frame(3);
    for (const char* step :
         {", \"view\": {\"colouring\": \"nope\"}", ", \"view\": {\"side_panel\": \"plots\"}",
          ", \"view\": {\"wireframe\": \"maybe\"}", ", \"view\": {\"bone_opacity\": 2}",
          ", \"locked\": [\"command/Nope\"]"}) {
        INFO(step);
        with(step);
        CHECK_THROWS_AS(player(d).start_file(file), Error);
        CHECK_FALSE(player(d).loading());
    }
    CHECK_THROWS_AS(player(d).start("no such lesson"), Error);
    with(
        ", \"view\": {\"wireframe\": true, \"bone_opacity\": 0.5}, \"task\": \"See through\", \"done_when\": "
        "[{\"view\": \"bone_opacity\", \"is\": \"0.4\"}]");
    player(d).start_file(file);
    CHECK(player(d).loading());
    wait_for(d, [&] { return player(d).active(); });
    CHECK(d.state().wireframe);
    CHECK_FALSE(player(d).done(0));
    d.state().bone_opacity = 0.4f; // as no double is
    d.frame(3);
    CHECK(player(d).done(0)); // nothing to do but to read
}
