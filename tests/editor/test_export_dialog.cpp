#include "editor/dialogs/dialogs.hpp"
#include "editor/driver.hpp"
#include "editor/features.hpp"
#include "fascicle/io/animation_file.hpp"
#include "fascicle/io/csv.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "fascicle/io/png.hpp"
#include "fascicle/io/run_reader.hpp"
#include "render/osmesa_context.hpp"
#include "support/temp_dir.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <gif_lib.h>
#include <thread>

using namespace fascicle;
using namespace fascicle::editor;
using fascicle::test::Driver;
using fascicle::test::TempDir;
namespace fs = std::filesystem;

namespace {

constexpr int key_e_code = 'E';

/// An editor with a finished run of `frames`, and the dialog open on a folder of its own.
struct Session {
    render::OsmesaContext gl;
    TempDir folder;
    Driver d{test::small_scene(), 900, 600}; // pictures of a small view are quick

    explicit Session(int frames = 5) {
        d.editor().use_gl();
        d.frame(3);
        d.run()->compute(frames);
        d.run()->finish();
        d.frame(3);
        d.state().exporting.folder = folder.path();
    }
    void open() {
        d.key(key_e_code, {.ctrl = true});
        d.frame(2);
    }
    void choose(const std::string& kind) {
        open();
        d.click("export/kind/" + kind);
    }
    /// Presses Export and waits for it.
    void run() {
        d.click("export/start");
        for (int i = 0; i < 4000 && d.editor().features().exporter.running(); ++i) {
            d.frame();
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        REQUIRE_FALSE(d.editor().features().exporter.running());
        d.frame(2);
    }
    void name(const std::string& text) {
        d.double_click("export/name");
        d.key(key_a, {.ctrl = true});
        d.type(text);
    }
    fs::path file(const std::string& what) const { return folder.path() / what; }
    /// Files and folders, hidden ones too.
    long entries() const {
        return std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator());
    }
};

} // namespace

TEST_CASE("Export of a picture at twice the view, and without a background", "[editor][ui][export]") {
    Session s;
    s.choose("picture");
    CHECK(s.d.has("export/scale/2"));
    s.name("view");
    s.d.click("export/scale/1");
    s.run();
    const PngImage once = read_png(s.file("view.png"));
    CHECK(once.width == s.d.state().view_width);
    CHECK(once.height == s.d.state().view_height);
    CHECK(once.rgba[3] == 255);
    s.open();
    CHECK(s.d.state().exporting.name == "view"); // as it was left
    s.d.click("export/scale/2");
    s.d.click("export/transparent");
    s.run();
    const PngImage twice = read_png(s.file("view.png"));
    CHECK(twice.width == 2 * once.width);
    CHECK(twice.height == 2 * once.height);
    CHECK(twice.rgba[3] == 0);
    CHECK(s.entries() == 1);
    CHECK(s.d.editor().log().latest()->text.find("view.png") != std::string::npos);
}

TEST_CASE("Export of numbered pictures and of a GIF of some frames", "[editor][ui][export]") {
    Session s(9);
    s.choose("frames");
    s.d.click("export/scale/own");
    s.d.state().exporting.width = 80;
    s.d.state().exporting.height = 50;
    s.d.click("export/some_frames");
    s.d.double_click("export/first");
    s.d.key(key_a, {.ctrl = true});
    s.d.type("2");
    s.d.key(key_enter);
    s.d.double_click("export/step");
    s.d.key(key_a, {.ctrl = true});
    s.d.type("3");
    s.d.key(key_enter);
    s.run();
    CHECK(read_png(s.file("small") / "small_0002.png").width == 80);
    CHECK(fs::exists(s.file("small") / "small_0005.png"));
    CHECK(fs::exists(s.file("small") / "small_0008.png"));
    CHECK(std::distance(fs::directory_iterator(s.file("small")), fs::directory_iterator()) == 3);
    s.choose("gif");
    s.d.click("export/all_frames");
    s.d.click("export/dither");
    CHECK_FALSE(s.d.state().exporting.dither);
    s.d.state().exporting.step = 1;
    s.run();
    int error = 0;
    GifFileType* gif = DGifOpenFileName(s.file("small.gif").c_str(), &error);
    REQUIRE(gif != nullptr);
    REQUIRE(DGifSlurp(gif) == GIF_OK);
    CHECK(gif->ImageCount == 9);
    CHECK(gif->SWidth == 80);
    DGifCloseFile(gif, &error);
}

TEST_CASE("Export of a film through the encoder that is there, with the reason where none is",
          "[editor][ui][export]") {
    Session s;
    const std::string before = std::getenv("PATH");
    ::setenv("PATH", s.folder.path().c_str(), 1);
    s.choose("video");
    s.d.frame(2);
    s.d.click("export/start");
    CHECK(s.entries() == 0); // the button is off
    write_file(s.file("ffmpeg"), "#!/bin/sh\nfor last; do :; done\ncat > \"$last\"\n");
    fs::permissions(s.file("ffmpeg"), fs::perms::owner_all);
    ::setenv("PATH", (s.folder.path().string() + ":" + before).c_str(), 1);
    s.d.state().exporting.scale = 0;
    s.d.state().exporting.width = 65;
    s.d.state().exporting.height = 48;
    s.d.frame(2);
    s.run();
    ::setenv("PATH", before.c_str(), 1);
    CHECK(fs::file_size(s.file("small.mp4")) == 5u * 4 * 64 * 48);
}

TEST_CASE("Export of meshes, numbers, a whole run and a report", "[editor][ui][export]") {
    Session s;
    s.d.key(key_right);
    s.choose("mesh");
    s.run();
    const MeshFile mesh = read_mesh_file(s.file("small.obj"));
    CHECK((mesh.mesh.positions[4] - (*s.d.run()->recording()->frame(1)->muscle_positions[0])[4]).norm() <
          1e-9);
    s.choose("metrics");
    s.run();
    const std::string bytes = read_file(s.file("small.csv"));
    CsvReader csv(bytes, "small.csv");
    int rows = 0;
    while (csv.next_row())
        rows += csv.number(csv.column("volume_ratio")) > 0.9 ? 1 : 0;
    CHECK(rows == 5);
    s.choose("meshes");
    s.name("meshes");
    s.run();
    CHECK(fs::exists(s.file("meshes") / "muscle_0004.vtp"));
    s.choose("run");
    s.name("run");
    s.run();
    CHECK(RunReader(s.file("run")).frames().size() == 5);
    s.choose("report");
    s.run();
    const std::string html = read_file(s.file("run.html"));
    CHECK(html.find("<svg") != std::string::npos);
    CHECK(html.find("data:image/png;base64,") != std::string::npos);
    CHECK(html.find("Volume ratio") != std::string::npos);
}

TEST_CASE("Export of a glTF with the shapes that were asked for, of a USD and of point caches",
          "[editor][ui][export]") {
    Session s(9);
    s.choose("glb");
    CHECK(s.d.has("export/morph_targets"));
    CHECK(s.d.has("export/up/y"));
    CHECK_FALSE(s.d.has("export/fps"));
    s.d.double_click("export/morph_targets");
    s.d.key(key_a, {.ctrl = true});
    s.d.type("4");
    s.d.click("export/up/y");
    CHECK(s.d.state().exporting.morph_targets == 4);
    s.run();
    Animation found = read_animation(s.file("small.glb"));
    CHECK(found.frames == std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7, 8}); // of the bone that turns
    CHECK(found.provenance.find("\"shape_frames\":[0,2,4,6,8]") != std::string::npos);
    const RecordingPtr recording = s.d.run()->recording();
    const auto muscle = std::find_if(found.bodies.begin(), found.bodies.end(),
                                     [](const AnimatedBody& body) { return body.name == "muscle"; });
    REQUIRE(muscle != found.bodies.end());
    Points points;
    for (const int k : {0, 4, 8}) {
        points_in_frame(*muscle, static_cast<std::size_t>(k), points);
        const Vec3 wanted = (*recording->frame(k)->muscle_positions[0])[7] / 1000; // y is up in it already
        CHECK((points[7] - wanted).norm() < 1e-7);
    }

    s.choose("usda");
    CHECK_FALSE(s.d.has("export/morph_targets"));
    s.d.click("export/some_frames");
    s.d.state().exporting.first = 2;
    s.d.state().exporting.last = 8;
    s.d.state().exporting.step = 3;
    s.run();
    found = read_animation(s.file("small.usda"));
    CHECK(found.frames == std::vector<int>{2, 5, 8});
    CHECK(found.up == 'y');
    points_in_frame(found.bodies.at(0), 2, points);
    CHECK((points[7] - (*recording->frame(8)->muscle_positions[0])[7]).norm() < 1e-4);

    s.choose("pc2");
    s.name("cache");
    s.d.state().exporting.last = 7; // which no step falls on
    s.run();
    found = read_animation(s.file("cache") / "muscle.pc2");
    CHECK(found.frames == std::vector<int>{2, 5});
    CHECK(fs::exists(s.file("cache") / "fixed.obj"));
    s.choose("json");
    s.run();
    CHECK(read_file(s.file("cache.json")).find("\"fascicle metrics\"") != std::string::npos);
}

TEST_CASE("Kinds that cannot be exported say why", "[editor][ui][export]") {
    render::OsmesaContext gl;
    Driver d;
    d.editor().use_gl();
    d.frame(3); // nothing computed yet
    d.key(key_e_code, {.ctrl = true});
    d.frame(2);
    for (const auto& row : output::export_kinds()) {
        d.click(std::string("export/kind/") + row.key);
        CHECK(d.state().exporting.kind == row.key);
        CHECK(d.has("export/estimate") == row.traits.rest);
    }
    d.click("export/cancel");
    CHECK_FALSE(d.has("export/start"));
    d.run()->compute(3); // while it runs: what there is
    d.frame(2);
    d.key(key_e_code, {.ctrl = true});
    d.frame(2);
    d.click("export/kind/gif");
    CHECK(d.has("export/estimate"));
    d.click("export/kind/fibres"); // the run has none
    CHECK_FALSE(d.has("export/estimate"));
    d.key(key_escape);
    d.frame(2);
    CHECK_FALSE(d.has("export/start"));
}

TEST_CASE("A badge counts while an export runs, the interface goes on, and Esc leaves nothing",
          "[editor][ui][export]") {
    Session s(61);
    s.choose("frames");
    s.d.state().exporting.scale = 0;
    s.d.state().exporting.width = 500;
    s.d.state().exporting.height = 400;
    s.d.click("export/start");
    REQUIRE(s.d.editor().features().exporter.running());
    CHECK(s.d.has("viewport/recording"));
    CHECK(s.d.editor().next_redraw().has_value());
    s.d.key(key_right); // the interface is alive
    CHECK(s.d.state().playback.playhead() == 1);
    s.open(); // one at a time
    CHECK_FALSE(s.d.has("export/start"));
    const output::ExportJob* job = s.d.editor().features().exporter.job();
    REQUIRE(job != nullptr);
    CHECK(job->total() == 61);
    s.d.key(key_escape);
    CHECK_FALSE(s.d.editor().features().exporter.running());
    for (int i = 0; i < 1000 && s.entries() > 0; ++i) {
        s.d.frame();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    CHECK(s.entries() == 0);
    s.d.frame(3);
    CHECK_FALSE(s.d.has("viewport/recording"));
    CHECK(s.d.editor().log().latest()->text.find("cancelled") != std::string::npos);
}

TEST_CASE("An export that fails keeps what was there, says why and offers another name",
          "[editor][ui][export]") {
    Session s;
    fs::create_directories(s.file("small.csv")); // a folder where the table should be
    s.choose("metrics");
    CHECK(s.d.has("export/note"));
    s.run();
    CHECK(s.d.has("export/problem")); // the dialog is back
    CHECK(s.d.editor().log().unseen_errors() == 1);
    CHECK(fs::is_directory(s.file("small.csv")));
    s.d.click("export/instead");
    CHECK(s.d.state().exporting.name == "small 2");
    CHECK_FALSE(s.d.has("export/problem"));
    s.run();
    CHECK(fs::is_regular_file(s.file("small 2.csv")));
    s.d.state().exporting.folder = "/proc";
    s.choose("picture");
    s.run();
    CHECK(s.d.has("export/problem"));
    CHECK_FALSE(fs::exists("/proc/small 2.png"));
    s.d.click("export/choose"); // another folder
    s.d.editor().dialogs();
    s.d.click("browser/up");
    s.d.click("export/start"); // use folder
    CHECK(s.d.state().exporting.folder == "/");
    s.d.click("export/cancel");
}
