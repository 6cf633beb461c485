#include "editor/dialogs/dialogs.hpp"
#include "editor/driver.hpp"
#include "editor/features.hpp"
#include "editor/scene_view.hpp"
#include "fascicle/document/actions/parameter_actions.hpp"
#include "fascicle/io/png.hpp"
#include "fascicle/io/run_writer.hpp"
#include "render/osmesa_context.hpp"
#include "support/shapes.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::editor;
using fascicle::test::Driver;

namespace {

/// Frames as HandRun makes them, the muscles moved by k times `step` in frame k.
void fill(Recording& recording, int count, const Vec3& step) {
    test::HandRun model(recording.scene_ptr());
    model.compute(count);
    recording.set_attachments(model.recording()->attachments());
    for (int k = recording.frame_count(); k < count; ++k) {
        Frame frame = *model.recording()->frame(k);
        for (PointsPtr& points : frame.muscle_positions) {
            auto moved = std::make_shared<Points>(*points);
            for (Vec3& p : *moved)
                p += k * step;
            points = moved;
        }
        recording.append(std::make_shared<const Frame>(std::move(frame)));
    }
}

void run_to_end(Driver& d, int count, const Vec3& step) {
    fill(*d.run()->recording(), count, step);
    d.run()->finish();
    d.frame(3);
}

/// Another value of the stiffness, and its run under way.
void change(Driver& d, double stiffness) {
    actions::set_parameter(d.document(), "solver.stiffness", stiffness);
    d.settle();
}

const Vec3 step(0.02, 0, 0);

/// Two finished runs: "Run 1" as B, and "Run 2", whose muscle moves by 0.02 mm a frame more, as A. The tab Compare is in front.
void two_runs(Driver& d, int frames_a = 61, int frames_b = 61) {
    d.frame(3);
    run_to_end(d, frames_b, Vec3::Zero());
    change(d, 0.5);
    run_to_end(d, frames_a, step);
    d.state().side_panel = "compare";
    d.frame(3);
}

Compare& compare(Driver& d) {
    return d.editor().features().compare;
}
RunShelf& shelf(Driver& d) {
    return d.editor().features().shelf;
}

void wait(Driver& d) {
    for (int i = 0; i < 200; ++i) {
        d.frame(2);
        if (!compare(d).busy())
            return;
        compare(d).finish();
    }
    FAIL("comparing does not end");
}

void go_to(Driver& d, int frame) {
    d.state().playback.position = frame;
    d.frame(2);
}

void write_run(const Recording& recording, const std::filesystem::path& folder, bool vtp, int every = 1) {
    RunOutputOptions options;
    options.vtp = vtp;
    options.every = every;
    RunWriter writer(folder, recording.scene_ptr(), options);
    writer.set_attachments(recording.attachments());
    MetricsEngine engine(recording);
    for (int k = 0; k < recording.frame_count(); ++k)
        writer.add_frame(recording.frame(k), engine.measure(*recording.frame(k)));
    writer.finish(recording);
}

double red_share(const render::Image& image, int from, int to) {
    double red = 0, all = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = from; x < to; ++x) {
            const std::uint8_t* p = &image.rgba[4 * static_cast<std::size_t>(y * image.width + x)];
            red += p[0] > p[1] + 40 && p[0] > p[2] + 40 ? 1 : 0;
            ++all;
        }
    return red / all;
}

} // namespace

TEST_CASE("Runs are kept when they end, the last six and the pinned ones", "[editor][compare]") {
    Driver d;
    d.frame(3);
    CHECK(shelf(d).runs().empty());
    run_to_end(d, 20, step);
    REQUIRE(shelf(d).runs().size() == 1);
    CHECK(shelf(d).runs()[0].name == "Run 1");
    CHECK(shelf(d).runs()[0].recording == d.editor().runs().recording());
    shelf(d).set_pinned(1, true);
    for (int i = 0; i < 9; ++i) {
        change(d, 0.1 + 0.05 * i);
        run_to_end(d, 20, step);
    }
    REQUIRE(shelf(d).runs().size() == RunShelf::kept_runs + 1);
    CHECK(shelf(d).runs().front().name == "Run 10");
    CHECK(shelf(d).runs().back().name == "Run 1");
    shelf(d).set_pinned(1, false);
    CHECK(shelf(d).find(1) == nullptr);

    d.editor().run(Command::run_again); // the same scene again is the same run
    d.frame(2);
    run_to_end(d, 20, step);
    CHECK(shelf(d).runs().front().name == "Run 10");
    CHECK(shelf(d).runs().front().recording == d.editor().runs().recording());
}

TEST_CASE("Runs that were stopped early or failed are not kept, long ones are", "[editor][compare]") {
    Driver d;
    d.frame(3);
    fill(*d.run()->recording(), RunShelf::usefully_long - 1, step);
    change(d, 0.5); // takes its place
    CHECK(shelf(d).runs().empty());
    fill(*d.run()->recording(), RunShelf::usefully_long, step);
    change(d, 0.6);
    REQUIRE(shelf(d).runs().size() == 1);
    CHECK(shelf(d).runs()[0].recording->frame_count() == RunShelf::usefully_long);
    fill(*d.run()->recording(), 30, step);
    d.run()->recording()->finish(RunState::failed, "not finite");
    d.frame(2);
    change(d, 0.7);
    CHECK(shelf(d).runs().size() == 1);
}

TEST_CASE("Kept runs stay below the memory they may use", "[editor][compare]") {
    Driver d;
    d.frame(3);
    run_to_end(d, 20, step);
    const std::size_t one = shelf(d).runs()[0].bytes;
    const std::size_t vertices = d.document().scene().muscles[0].mesh->positions.size();
    CHECK(one >= 20 * vertices * sizeof(Vec3));
    CHECK(one < 20 * (vertices * sizeof(Vec3) + sizeof(Frame) + 1000));
    shelf(d).set_byte_limit(one * 5 / 2);
    for (int i = 0; i < 3; ++i) {
        change(d, 0.3 + 0.1 * i);
        run_to_end(d, 20, step);
        CHECK(shelf(d).bytes() <= one * 5 / 2);
    }
    CHECK(shelf(d).runs().size() == 2);
    CHECK(shelf(d).runs()[0].name == "Run 4");
}

TEST_CASE("The present run is A and the one before it is B, until somebody chooses",
          "[editor][compare][ui]") {
    Driver d;
    two_runs(d);
    CHECK(compare(d).a().name == "Run 2");
    CHECK(compare(d).b().name == "Run 1");
    CHECK(compare(d).reason().empty());
    change(d, 0.3);
    CHECK(compare(d).a().name == "Present run");
    CHECK(compare(d).b().name == "Run 2");
    CHECK(compare(d).reason() == "Present run has no frames yet");
    run_to_end(d, 61, 2 * step);
    CHECK(compare(d).a().name == "Run 3");
    CHECK(d.has("compare/run/3/a"));
    d.click("compare/run/1/b");
    CHECK(compare(d).b().name == "Run 1");
    d.click("compare/run/2/a");
    CHECK(compare(d).a().name == "Run 2");
    d.click("compare/swap");
    CHECK(compare(d).a().name == "Run 1");
    CHECK(compare(d).b().name == "Run 2");
    d.click("compare/run/1/b");
    CHECK(compare(d).reason() == "A and B are the same run");
    CHECK(d.has("compare/reason"));
    d.click("compare/run/3/a"); // the present run, whichever it is
    change(d, 0.2);
    CHECK(compare(d).a().recording == d.editor().runs().recording());
    CHECK(d.has("compare/present/a"));
}

TEST_CASE("Kept runs can be renamed, pinned and deleted in the list", "[editor][compare][ui]") {
    Driver d;
    two_runs(d);
    d.double_click("compare/run/1/name");
    d.type("soft");
    d.key(key_enter);
    CHECK(shelf(d).find(1)->name == "soft");
    CHECK(compare(d).b().name == "soft");
    d.double_click("compare/run/1/name");
    d.type("other");
    d.key(key_escape);
    CHECK(shelf(d).find(1)->name == "soft");
    d.click("compare/run/1/pin");
    CHECK(shelf(d).find(1)->pinned);
    d.click("compare/run/1/pin");
    CHECK_FALSE(shelf(d).find(1)->pinned);
    d.click("compare/run/2/delete");
    CHECK(shelf(d).find(2) == nullptr);
    d.frame(3);
    CHECK(shelf(d).runs().size() == 1); // and does not come back
}

TEST_CASE("Use these parameters is one step that undo takes back", "[editor][compare][ui]") {
    Driver d;
    two_runs(d);
    const auto value = [&] { return d.document().scene().parameters.get("solver.stiffness"); };
    CHECK(value() == 0.5);
    const std::size_t steps = d.document().history().steps().size();
    d.click("compare/run/1/use");
    CHECK(value() == 0.9);
    CHECK_FALSE(d.document().scene().parameters.edited("solver.stiffness")); // it is the default
    CHECK(d.document().history().steps().size() == steps + 1);
    CHECK(d.document().history().undo_name() == "Use parameters of Run 1");
    d.click("compare/run/1/use");
    CHECK(d.document().history().steps().size() == steps + 1); // nothing to change, no step
    d.key(key_z, {.ctrl = true});
    CHECK(value() == 0.5);
}

TEST_CASE("Parameters of a run of the other method are taken over as they were", "[editor][compare]") {
    Driver d;
    ParamSet wanted = default_parameters();
    set_method(wanted, "classic");
    wanted.set("solver.bending", 0.4);
    CHECK(actions::use_parameters(d.document(), wanted, "Use"));
    const ParamSet& now = d.document().scene().parameters;
    CHECK(now == wanted);
    CHECK(now.edited("solver.bending"));
    CHECK_FALSE(now.edited("solver.damping"));
}

TEST_CASE("Distances at the playhead and over all frames are those of the runs", "[editor][compare][ui]") {
    Driver d;
    two_runs(d);
    wait(d);
    go_to(d, 30);
    REQUIRE(compare(d).at_playhead() != nullptr);
    CHECK(compare(d).at_playhead()->muscles[0].rms_mm == Approx(0.6));
    CHECK(compare(d).at_playhead()->muscles[0].max_mm == Approx(0.6));
    REQUIRE(compare(d).summary().size() == 1);
    CHECK(compare(d).summary()[0].max_mm == Approx(1.2));
    CHECK(compare(d).summary()[0].max_index == 60);
    CHECK(compare(d).progress() == 1);
    d.click("compare/worst/muscle");
    CHECK(d.state().playback.playhead() == 60);
    CHECK(d.has("compare/parameter/solver.stiffness"));
    CHECK_FALSE(d.has("compare/parameter/solver.bending"));
    d.frame(5);
    CHECK_FALSE(compare(d).redraw_after()); // rests
}

TEST_CASE("A shorter run stays at its last frame and says so", "[editor][compare][ui]") {
    Driver d;
    two_runs(d, 61, 21);
    wait(d);
    d.click("compare/side_by_side");
    go_to(d, 15);
    CHECK_FALSE(compare(d).b().ended);
    go_to(d, 40);
    CHECK(compare(d).b().ended);
    CHECK(compare(d).b().frame->index == 20);
    CHECK(compare(d).a().frame->index == 40);
    CHECK(compare(d).frames().size() == 21);
    CHECK(d.rect("viewport/b").width() > d.rect("viewport/a").width()); // "..., ends at frame 20"
}

TEST_CASE("Every way of comparing has its button, shows in the view and goes off again",
          "[editor][compare][ui]") {
    Driver d;
    two_runs(d);
    for (const CompareModeRow& row : compare_modes()) {
        INFO(row.key);
        d.click(std::string("compare/") + row.key);
        CHECK(compare(d).active(row.mode));
        CHECK(d.has("viewport/a"));
        CHECK(d.has("viewport/b") == (row.mode != CompareMode::blink));
        CHECK(d.has("viewport/legend"));
    }
    d.click("compare/ghost");
    d.click("compare/wire");
    CHECK(compare(d).choice.wire);
    d.click("compare/translucent");
    CHECK_FALSE(compare(d).choice.wire);
    d.click("compare/off");
    CHECK_FALSE(compare(d).active());
    CHECK_FALSE(d.has("viewport/a"));
}

TEST_CASE("While areas are painted the view shows the scene, and the comparison afterwards again",
          "[editor][compare][ui]") {
    Driver d;
    two_runs(d);
    d.click("compare/blink");
    compare(d).choice.shows_b = true;
    d.frame(2);
    REQUIRE(compare(d).active());
    const RecordingPtr present = d.editor().context().runs.recording();
    REQUIRE(compare(d).b().recording != present);
    d.state().selection = {Selection::Kind::bone, d.document().scene().bones[0].name};
    d.key(key_tab);
    REQUIRE(d.state().tool == Tool::paint);
    d.state().side_panel = "compare";
    d.frame(2);
    CHECK_FALSE(compare(d).active());
    CHECK(d.has("compare/aside"));
    CHECK(d.editor().context().shown().recording == present);
    const EditorContext context = d.editor().context();
    CHECK(view_subject(context).areas == context.features.paint.shown_areas(context)); // the strokes are seen
    d.key(key_tab);
    d.frame(2);
    CHECK(compare(d).active());
    CHECK_FALSE(d.has("compare/aside"));
    CHECK(d.editor().context().shown().recording == compare(d).b().recording);
}

TEST_CASE("Playing goes over the frames of the runs that are compared", "[editor][compare][ui]") {
    Driver d;
    two_runs(d);
    change(d, 0.3); // a third run begins, and has five frames for now
    fill(*d.run()->recording(), 5, step);
    d.frame(3);
    REQUIRE(d.editor().runs().recording()->frame_count() == 5);
    d.state().playback = {};
    d.state().playback.repeat = Repeat::once;
    d.state().playback.position = 40;
    compare(d).choice.a = 2;
    compare(d).choice.b = 1;
    d.click("compare/side_by_side");
    REQUIRE(compare(d).active());
    CHECK(d.editor().context().available_frames() == 61);
    CHECK_FALSE(d.editor().context().frames_come());
    d.key(key_space);
    for (int i = 0; i < 400 && d.state().playback.playing; ++i)
        d.frame();
    CHECK_FALSE(d.state().playback.playing); // it came to the end
    CHECK(d.state().playback.playhead() == 60);
    d.click("compare/off");
    CHECK(d.editor().context().frames_come());
}

TEST_CASE("B blinks between the runs, Shift+B begins and ends comparing", "[editor][compare][ui]") {
    Driver d;
    d.frame(3);
    d.key(key_b); // nothing to compare yet
    CHECK(compare(d).choice.mode == CompareMode::off);
    two_runs(d);
    const auto seen = [&] { return compare(d).shown() ? compare(d).shown()->recording : nullptr; };
    d.key(key_b);
    CHECK(compare(d).choice.mode == CompareMode::blink);
    CHECK(seen() == shelf(d).find(1)->recording);
    CHECK(d.has("viewport/b"));
    d.key(key_b);
    CHECK(seen() == shelf(d).find(2)->recording);
    CHECK(d.has("viewport/a"));
    d.click("compare/flip");
    CHECK(seen() == shelf(d).find(1)->recording);
    d.key(key_b, {.shift = true});
    CHECK_FALSE(compare(d).active());
    d.key(key_b, {.shift = true});
    CHECK(compare(d).active(CompareMode::side_by_side));
    d.key(key_b, {.ctrl = true}); // not ours
    CHECK(compare(d).active(CompareMode::side_by_side));
}

TEST_CASE("Blinking by itself keeps its time without any input", "[editor][compare][ui]") {
    Driver d;
    two_runs(d);
    d.click("compare/blink");
    d.frame(120);
    CHECK_FALSE(compare(d).choice.shows_b); // by key alone
    d.click("compare/blink_auto");
    int flips = 0;
    bool before = compare(d).choice.shows_b;
    for (int i = 0; i < 60 * 7; ++i) {
        d.frame();
        REQUIRE(compare(d).redraw_after());
        CHECK(*compare(d).redraw_after() <= 0.71);
        flips += compare(d).choice.shows_b != before;
        before = compare(d).choice.shows_b;
    }
    CHECK(flips >= 9);
    CHECK(flips <= 10);
    const Rect slider = d.rect("compare/blink_seconds");
    d.drag(d.middle("compare/blink_seconds"), {slider.max.x + 20, slider.min.y + 5});
    CHECK(compare(d).choice.blink_seconds == Approx(3));
}

TEST_CASE("The range of the difference map is fitted, or what somebody sets", "[editor][compare][ui]") {
    Driver d;
    two_runs(d);
    wait(d);
    d.click("compare/difference");
    CHECK(compare(d).difference_scale().low == 0);
    CHECK(compare(d).difference_scale().high == 2); // above twice 0.70 mm
    CHECK(compare(d).difference_scale().map == view::ColourMap::viridis);
    d.click("compare/cividis");
    CHECK(compare(d).difference_scale().map == view::ColourMap::cividis);
    d.click("compare/fit_range");
    CHECK_FALSE(compare(d).choice.range_follows);
    CHECK(compare(d).difference_scale().high == 2);
    const Rect range = d.rect("compare/range");
    const float x = range.min.x + range.width() * 0.75f, y = (range.min.y + range.max.y) / 2;
    d.drag({x, y}, {x + 50, y});
    CHECK(compare(d).difference_scale().high > 2.2);
    d.click("compare/fit_range");
    CHECK(compare(d).difference_scale().high == 2);
    d.state().colouring = view::Colouring::strain; // would not be seen under the map
    d.frame(2);
    CHECK_FALSE(compare(d).active());
}

TEST_CASE("Two pictures side by side share a camera and each can be picked in", "[editor][compare][ui]") {
    Driver d;
    two_runs(d);
    d.key(key_b, {.shift = true});
    d.key(key_f, {.shift = true});
    d.frame(3);
    const Rect view = d.rect("viewport");
    const float quarter = view.width() / 4, y = (view.min.y + view.max.y) / 2;
    const ImVec2 left{view.min.x + quarter, y}, right{view.min.x + 3 * quarter, y};
    // The same place of both pictures is the same thing: the muscle in the middle.
    for (const ImVec2 place : {left, right}) {
        d.state().selection = {};
        d.move_to(place);
        d.press();
        d.release();
        d.frame(20);
        CHECK(d.state().selection == Selection{Selection::Kind::muscle, "muscle"});
    }
    for (const ImVec2 place : {left, right}) {
        const Vec3 eye = d.state().camera.eye();
        d.drag(place, {place.x + 40, place.y});
        CHECK((d.state().camera.eye() - eye).norm() > 1);
    }
    // A drag over the border goes on.
    const Vec3 eye = d.state().camera.eye();
    d.drag({left.x + quarter - 10, y}, {right.x, y});
    CHECK((d.state().camera.eye() - eye).norm() > 1);
    CHECK(d.state().view_aspect == Approx(double(view.width()) / 2 / double(view.height())).epsilon(0.02));
}

TEST_CASE("The picture shows A and B as each way of comparing says", "[editor][compare][picture]") {
    const render::OsmesaContext gl;
    Driver d(test::small_scene(), 900, 600);
    d.editor().use_gl();
    two_runs(d);
    wait(d);
    go_to(d, 60);
    const int width = static_cast<int>(d.rect("viewport").width());
    std::map<std::string, render::Image> images;
    const view::Camera camera = d.state().camera;
    const auto take = [&](const std::string& name) {
        d.frame(2);
        d.state().camera = camera; // two pictures side by side are framed anew
        const test::TempDir folder;
        d.state().wants_picture = folder.path() / "view.png";
        d.frame();
        const PngImage png = read_png(folder.path() / "view.png");
        images[name] = {png.width, png.height, png.rgba};
    };
    take("off");
    for (const CompareModeRow& row : compare_modes()) {
        compare(d).choice.mode = row.mode;
        take(row.key);
        CHECK(images[row.key].width == width);
        if (row.mode != CompareMode::blink)
            CHECK(images[row.key].rgba != images["off"].rgba);
    }
    compare(d).choice.mode = CompareMode::blink;
    CHECK(images["blink"].rgba == images["off"].rgba); // A is the present run
    compare(d).choice.shows_b = true;
    take("b");
    CHECK(images["b"].rgba != images["off"].rgba);
    compare(d).choice.mode = CompareMode::ghost;
    compare(d).choice.wire = true;
    take("wire");
    CHECK(images["wire"].rgba != images["ghost"].rgba);
    const render::Image& two = images["side_by_side"];
    CHECK(red_share(two, 0, two.width / 2) > 0.01); // a muscle in each half
    CHECK(red_share(two, two.width / 2, two.width) > 0.01);
    CHECK(red_share(images["difference"], 0, width) < red_share(images["off"], 0, width) / 2);

    // Both pictures are drawn once, and again only when something changes.
    compare(d).choice.mode = CompareMode::side_by_side;
    d.frame(3);
    REQUIRE(compare(d).second_view() != nullptr);
    const int drawn = compare(d).second_view()->drawn();
    d.frame(5);
    CHECK(compare(d).second_view()->drawn() == drawn);
    d.key(key_left);
    CHECK(compare(d).second_view()->drawn() == drawn + 1);
}

TEST_CASE("A run folder is loaded, kept and compared", "[editor][compare][ui]") {
    const test::TempDir folder;
    const auto scene = std::make_shared<const Scene>(test::small_scene());
    Recording stored(scene);
    fill(stored, 21, 3 * step);
    stored.finish(RunState::finished);
    write_run(stored, folder.path() / "stored", true, 4);

    Driver d;
    two_runs(d);
    d.click("compare/load");
    CHECK(d.editor().dialogs().run.is_open());
    d.click("browser/path");
    d.type((folder.path() / "stored").string());
    d.key(key_enter);
    d.frame(3);
    d.click("run/load");
    CHECK_FALSE(d.editor().dialogs().run.is_open());
    shelf(d).finish_loading();
    d.frame(3);
    const KeptRun* run = shelf(d).find(shelf(d).loaded());
    REQUIRE(run != nullptr);
    CHECK(run->name == "stored");
    CHECK(run->pinned);
    CHECK(run->recording->scene().timeline.angle_rad(8) == Approx(scene->timeline.angle_rad(8)));
    d.click("compare/run/" + std::to_string(run->id) + "/b");
    wait(d);
    CHECK(compare(d).reason().empty());
    go_to(d, 12);
    CHECK(compare(d).at_playhead()->muscles[0].max_mm ==
          Approx(12 * 0.04).epsilon(1e-4)); // files hold floats
    CHECK(compare(d).frames().size() == 6); // 0, 4, ..., 20
    go_to(d, 14);
    CHECK(compare(d).b().ended);
    CHECK(compare(d).b().frame->index == 12);
}

TEST_CASE("A folder that is no run with frames is refused in one line", "[editor][compare][ui]") {
    const test::TempDir folder;
    write_run(*test::small_recording(5), folder.path() / "bare", false);
    Driver d;
    two_runs(d);
    d.editor().run(Command::load_run);
    d.frame(3);
    d.click("browser/path");
    d.type(folder.path().string());
    d.key(key_enter);
    d.frame(2);
    d.click("run/load"); // no run here: not live
    CHECK(d.editor().dialogs().run.is_open());
    d.key(key_escape);
    CHECK_FALSE(d.editor().dialogs().run.is_open());
    shelf(d).load(folder.path() / "bare");
    d.frame(2);
    shelf(d).finish_loading();
    d.frame(3);
    CHECK(shelf(d).problem().find("the run has no frames as files") != std::string::npos);
    CHECK(shelf(d).problem().find('\n') == std::string::npos);
    CHECK(d.has("compare/problem"));
    CHECK(shelf(d).runs().size() == 2);
    shelf(d).load(folder.path() / "bare");
    shelf(d).cancel_loading();
    d.frame(3);
    CHECK_FALSE(shelf(d).loading());
    CHECK(shelf(d).problem().empty());
}

TEST_CASE("Runs of other meshes are not compared, and the panel says why", "[editor][compare][ui]") {
    const test::TempDir folder;
    Scene other = test::small_scene();
    other.muscles[0].mesh = std::make_shared<const TriMesh>(test::sphere(15, 1, Vec3(40, 10, 20)));
    write_run(*test::small_recording(5, other), folder.path() / "other", true);
    Driver d;
    two_runs(d);
    shelf(d).load(folder.path() / "other");
    shelf(d).finish_loading();
    d.frame(3);
    CHECK(compare(d).b().name == "Run 1"); // not by itself
    d.click("compare/run/" + std::to_string(shelf(d).loaded()) + "/b");
    CHECK(compare(d).reason().find("muscle has other meshes") == 0);
    CHECK(d.has("compare/reason"));
    d.click("compare/ghost");
    CHECK_FALSE(compare(d).active());
    CHECK(compare(d).choice.mode == CompareMode::off); // the button is not live
    d.click("compare/run/1/b");
    CHECK(compare(d).reason().empty());
}

TEST_CASE("Difference curves are B minus A and share the playhead", "[editor][compare][ui]") {
    Driver d;
    two_runs(d);
    d.click("compare/curves");
    CHECK(d.state().bottom_panel == "differences");
    wait(d);
    d.editor().metrics().finish();
    d.frame(3);
    REQUIRE(compare(d).metrics_a() != nullptr);
    REQUIRE(compare(d).metrics_b() != nullptr);
    const MetricRows a = measure_run(*compare(d).a().recording), b = measure_run(*compare(d).b().recording);
    const FramePair& frame = compare(d).frames()[40];
    const MatchedMuscle& muscle = compare(d).match().muscles[0];
    for (const char* key : {"volume_ratio", "penetration_max_mm", "hausdorff_to_rest_mm"})
        CHECK(metric_difference(*compare(d).metrics_a(), *compare(d).metrics_b(), frame, muscle,
                                metric_index(key)) ==
              metric_difference(a, b, frame, muscle, metric_index(key)));
    CHECK(metric_difference(a, b, frame, muscle, metric_index("hausdorff_to_rest_mm")) < -0.01);
    for (const char* name :
         {"difference/distance/area", "difference/volume_ratio/area", "difference/edge_extension/area",
          "difference/dihedral_change/area", "difference/penetration/area"}) {
        INFO(name);
        CHECK(d.has(name));
    }
    CHECK_FALSE(d.has("difference/moment_arm/area")); // no fibres in this scene
    const Rect area = d.rect("difference/distance/area");
    d.move_to({area.min.x + area.width() / 4, (area.min.y + area.max.y) / 2});
    d.frame();
    REQUIRE(d.state().hover_frame);
    CHECK(*d.state().hover_frame == Approx(15).margin(1));
    d.drag({area.min.x + 5, area.min.y + 20}, {area.min.x + area.width() / 2, area.min.y + 20});
    CHECK(d.state().playback.playhead() == Approx(30).margin(1));
}

TEST_CASE("Another document forgets the runs but those that are pinned", "[editor][compare]") {
    Driver d;
    two_runs(d);
    shelf(d).set_pinned(1, true);
    compare(d).choice.mode = CompareMode::ghost;
    d.frame(2);
    Scene other = test::small_scene();
    other.muscles[0].mesh = std::make_shared<const TriMesh>(test::sphere(15, 1, Vec3(40, 10, 20)));
    d.editor().replace_document(Document(std::move(other)));
    d.frame(3);
    CHECK_FALSE(compare(d).active());
    REQUIRE(shelf(d).runs().size() == 1);
    CHECK(shelf(d).runs()[0].id == 1);
    run_to_end(d, 20, step);
    CHECK(compare(d).reason() == "no other run has the same muscles");
}

TEST_CASE("The panels of comparing draw empty, loading, full and failed, at any size",
          "[editor][compare][panels]") {
    const test::TempDir folder;
    write_run(*test::small_recording(30), folder.path() / "stored", true);
    for (const auto& [width, height, scale] :
         {std::tuple{1280.0f, 800.0f, 1.0f}, {640.0f, 400.0f, 1.0f}, {2560.0f, 1600.0f, 2.0f}}) {
        Driver d(test::small_scene(), width, height, scale);
        d.state().side_panel = "compare";
        d.state().bottom_panel = "differences";
        d.frame(3); // no frames yet
        if (width > 1000)
            CHECK(d.has("compare/reason"));
        two_runs(d);
        shelf(d).load(folder.path() / "stored");
        d.frame();
        if (width > 1000)
            CHECK((d.has("compare/loading") || !shelf(d).loading()));
        shelf(d).finish_loading();
        wait(d);
        for (const CompareModeRow& row : compare_modes()) {
            compare(d).choice.mode = row.mode;
            d.frame(3);
            d.state().dark = !d.state().dark;
        }
        shelf(d).load(folder.path());
        shelf(d).finish_loading();
        d.frame(3);
        CHECK_FALSE(shelf(d).problem().empty());
        for (const char* name :
             {"compare/side_by_side", "compare/difference", "compare/load", "compare/run/2/delete"})
            if (width > 1000) {
                INFO(name);
                CHECK(d.rect(name).min.x >= d.editor().layout().parameters.min.x);
                CHECK(d.rect(name).max.x <= d.editor().layout().parameters.max.x);
            }
    }
    Driver none(Scene{});
    none.state().side_panel = "compare";
    none.state().bottom_panel = "differences";
    none.frame(3);
    CHECK(compare(none).reason() == "there is no run yet");
}
