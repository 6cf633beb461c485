#include "editor/hand_run.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/png.hpp"
#include "output/export_job.hpp"
#include "output/run_pictures.hpp"
#include "render/osmesa_context.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>
#include <gif_lib.h>
#include <set>
#include <thread>

using namespace fascicle;
using namespace fascicle::output;
using fascicle::test::TempDir;
namespace fs = std::filesystem;

namespace {

ExportRequest request(const std::string& kind, const fs::path& target, int last = 0) {
    ExportRequest r;
    r.kind = kind;
    r.target = target;
    r.last = last;
    return r;
}

PictureLook look_at(const Recording& recording, int width, int height) {
    PictureLook look;
    look.camera = view::picture_camera(view::subject_of(recording, 0), double(width) / height);
    look.width = width;
    look.height = height;
    return look;
}

std::string error_of(ExportJob& job) {
    try {
        job.finish();
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

} // namespace

TEST_CASE("Every kind of export has a row, and targets get its extension", "[output][unit]") {
    std::set<std::string> keys;
    for (const ExportKindRow& row : export_kinds()) {
        CHECK(&export_kind(row.key) == &row);
        CHECK((row.write == nullptr) == row.traits.draws);
        CHECK(keys.insert(row.key).second);
        CHECK(row.traits.folder == (*row.extension == 0));
    }
    CHECK(with_extension("a/b", "gif") == "a/b.gif");
    CHECK(with_extension("a/b.GIF", "gif") == "a/b.GIF");
    CHECK(with_extension("v1.2", "video") == "v1.2.mp4");
    CHECK(with_extension("a/b", "frames") == "a/b");
    CHECK(allowed_side(1001, "video") == 1000);
    CHECK(allowed_side(1001, "gif") == 1001);
    CHECK(allowed_side(3, "picture") == 16);
    const TempDir folder;
    write_file(folder.path() / "a.gif", "");
    write_file(folder.path() / "a 2.gif", "");
    CHECK(free_name(folder.path() / "a.gif") == folder.path() / "a 3.gif");
}

TEST_CASE("Numbered pictures carry the numbers of their frames", "[output][picture]") {
    const render::OsmesaContext gl;
    const TempDir folder;
    const RecordingPtr recording = test::small_recording(11);
    ExportRequest r = request("frames", folder.path() / "hip", 10);
    r.step = 5;
    PictureLook look = look_at(*recording, 90, 60);
    look.transparent = true;
    ExportJob job(r, recording, look);
    CHECK(job.total() == 3);
    job.finish();
    CHECK(job.drawn() == 3);
    CHECK(job.fraction() == 1);
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(r.target))
        names.insert(entry.path().filename().string());
    CHECK(names == std::set<std::string>{"hip_0000.png", "hip_0005.png", "hip_0010.png"});
    const PngImage first = read_png(r.target / "hip_0000.png"), last = read_png(r.target / "hip_0010.png");
    CHECK(first.width == 90);
    CHECK(first.height == 60);
    CHECK(first.rgba[3] == 0);
    CHECK(first.rgba != last.rgba);
}

TEST_CASE("A GIF of a run moves as the run does", "[output][picture]") {
    const render::OsmesaContext gl;
    const TempDir folder;
    const RecordingPtr recording = test::small_recording(7);
    ExportRequest r = request("gif", folder.path() / "hip.gif", 6);
    r.fps = 20;
    ExportJob job(r, recording, look_at(*recording, 120, 80));
    job.finish();
    int error = 0;
    GifFileType* gif = DGifOpenFileName(r.target.c_str(), &error);
    REQUIRE(gif != nullptr);
    REQUIRE(DGifSlurp(gif) == GIF_OK);
    CHECK(gif->ImageCount == 7);
    CHECK(gif->SWidth == 120);
    CHECK(gif->SHeight == 80);
    for (int k = 1; k < 7; ++k)
        CHECK(gif->SavedImages[k].ImageDesc.Width > 4); // something moved
    // The first picture against the same as a PNG.
    FramePainter painter;
    const render::Image wanted = painter.paint(view::subject_of(*recording, 0), look_at(*recording, 120, 80));
    double sum = 0;
    for (std::size_t i = 0; i < 120 * 80; ++i) {
        const GifColorType& c = gif->SColorMap->Colors[gif->SavedImages[0].RasterBits[i]];
        sum += std::abs(c.Red - wanted.rgba[4 * i]) + std::abs(c.Green - wanted.rgba[4 * i + 1]) +
               std::abs(c.Blue - wanted.rgba[4 * i + 2]);
    }
    CHECK(sum / (3 * 120 * 80) < 3);
    DGifCloseFile(gif, &error);
}

TEST_CASE("A film needs an encoder and says what helps without one", "[output][picture]") {
    const render::OsmesaContext gl;
    const TempDir folder;
    const RecordingPtr recording = test::small_recording(4);
    const std::string before = std::getenv("PATH");
    const ExportRequest r = request("video", folder.path() / "hip.mp4", 3);
    ::setenv("PATH", folder.path().c_str(), 1);
    std::string error;
    {
        ExportJob job(r, recording, look_at(*recording, 64, 48));
        error = error_of(job);
    }
    CHECK(error.find("ffmpeg") != std::string::npos);
    CHECK(error.find("GIF") != std::string::npos);
    CHECK(fs::is_empty(folder.path()));
    ::setenv("PATH", (folder.path().string() + ":" + before).c_str(), 1);
    write_file(folder.path() / "ffmpeg", "#!/bin/sh\nfor last; do :; done\ncat > \"$last\"\n");
    fs::permissions(folder.path() / "ffmpeg", fs::perms::owner_all);
    {
        ExportJob job(r, recording, look_at(*recording, 65, 49)); // odd sizes become even
        job.finish();
    }
    ::setenv("PATH", before.c_str(), 1);
    CHECK(fs::file_size(r.target) == 4u * 4 * 64 * 48);
}

TEST_CASE("An export that is cancelled while it draws leaves nothing", "[output][picture]") {
    const render::OsmesaContext gl;
    const RecordingPtr recording = test::small_recording(30);
    for (const std::string kind : {"frames", "gif", "report"}) {
        const TempDir folder;
        {
            ExportJob job(request(kind, output::with_extension(folder.path() / "new" / "x", kind), 29),
                          recording, look_at(*recording, 64, 48));
            for (int i = 0; i < 100 && job.drawn() < 2; ++i) {
                job.draw(0);
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            }
            CHECK(job.drawn() >= 1);
            job.cancel();
            CHECK_THROWS_AS(job.finish(), Cancelled);
        }
        fs::remove(folder.path() / "new"); // atomic files make folders and leaves them, empty
        CHECK(fs::is_empty(folder.path()));
    }
}

TEST_CASE("An export into a place that cannot be written to fails in one line", "[output][picture]") {
    const render::OsmesaContext gl;
    const RecordingPtr recording = test::small_recording(3);
    for (const ExportKindRow& row : export_kinds()) {
        if (std::string(row.key) == "video" || std::string(row.key) == "fibres" ||
            std::string(row.key) == "osim")
            continue; // no encoder, no fibres
        INFO(row.key);
        ExportJob job(request(row.key, with_extension("/proc/fascicle/x", row.key), 2), recording,
                      look_at(*recording, 32, 32));
        const std::string error = error_of(job);
        CHECK(error.find("/proc/fascicle") != std::string::npos);
        CHECK(error.find('\n') == std::string::npos);
    }
}

TEST_CASE("A picture of a scene without any run", "[output][picture]") {
    const render::OsmesaContext gl;
    const TempDir folder;
    const auto recording = std::make_shared<Recording>(std::make_shared<const Scene>(test::small_scene()));
    PictureLook look;
    look.camera = view::picture_camera(view::subject_of(recording->scene_ptr()), 1);
    look.width = look.height = 50;
    ExportJob job(request("picture", folder.path() / "rest.png"), recording, look);
    job.finish();
    CHECK(read_png(folder.path() / "rest.png").width == 50);
    CHECK_THROWS_AS(ExportJob(request("gif", folder.path() / "x.gif"), recording, look), Error);
}
