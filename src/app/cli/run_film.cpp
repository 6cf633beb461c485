#include "app/cli/run_film.hpp"

#include "app/cli/run_scene.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/base/interrupt.hpp"
#include "fascicle/io/gif_file.hpp"
#include "output/export_job.hpp"
#include "render/osmesa_context.hpp"

#include <cctype>

namespace fascicle::app {

namespace {

output::PictureLook look_of(const RecordingPtr& recording, const output::PictureOptions& options) {
    const output::Pictures pictures(*recording, options);
    output::PictureLook look;
    look.camera = pictures.camera(double(options.width) / options.height);
    look.options = pictures.options();
    look.width = options.width;
    look.height = options.height;
    return look;
}

void run(const output::ExportRequest& request, const RecordingPtr& recording, const output::PictureLook& look,
         ProgressDisplay& progress) {
    const render::OsmesaContext gl;
    output::ExportJob job(request, recording, look);
    try {
        job.finish(&watch_interrupts(), [&](double fraction) {
            progress.update({job.stage(), fraction, job.drawn(), job.total()}, steady_seconds());
        });
    } catch (const Cancelled&) {
        progress.finish();
        throw_error(request.target.string(), "cancelled, nothing was written");
    }
    progress.finish();
}

} // namespace

std::string FilmOptions::kind() const {
    std::string extension = out.extension().string();
    for (char& c : extension)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const std::string found = extension.empty()     ? "frames"
                              : extension == ".gif" ? "gif"
                              : extension == ".mp4" ? "video"
                                                    : "picture";
    if (found == "picture")
        throw_error("--out", "got '" + out.string() + "' for several frames",
                    "a folder, FILE.gif or FILE.mp4", ErrorKind::usage);
    const double most = found == "gif" ? gif_most_fps : 240;
    if (!(fps >= 0.1 && fps <= most))
        throw_error("--fps", "got " + number_text(fps), "0.1 to " + number_text(most), ErrorKind::usage);
    if (transparent && found != "frames")
        throw_error("--transparent", "a film has a background", "a folder of pictures", ErrorKind::usage);
    return found;
}

void write_film(const FilmOptions& options, const RecordingPtr& recording,
                const output::PictureOptions& picture, ProgressDisplay& progress) {
    output::ExportRequest request;
    request.kind = options.kind();
    request.target = options.out;
    request.first = options.range.first;
    request.last = options.range.last.value_or(recording->last_frame()->index);
    request.step = options.range.step;
    request.fps = options.fps;
    output::PictureLook look = look_of(recording, picture);
    look.transparent = options.transparent;
    run(request, recording, look, progress);
}

void write_drawn(const output::ExportRequest& request, const RecordingPtr& recording,
                 ProgressDisplay& progress) {
    output::PictureOptions picture;
    picture.width = 1200;
    picture.height = 800;
    run(request, recording, look_of(recording, picture), progress);
}

void write_report(const std::filesystem::path& out, const RecordingPtr& recording, int threads,
                  ProgressDisplay& progress) {
    output::ExportRequest request;
    request.kind = "report";
    request.target = out;
    request.threads = threads;
    write_drawn(request, recording, progress);
}

} // namespace fascicle::app
