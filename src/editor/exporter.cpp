#include "editor/exporter.hpp"

#include "editor/scene_view.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/base/parallel.hpp"

namespace fascicle::editor {

namespace fs = std::filesystem;
using State = output::ExportJob::State;

RecordingPtr exported_recording(const EditorContext& context) {
    if (const ShownFrame shown = context.shown(); shown.recording != nullptr)
        return shown.recording;
    return std::make_shared<Recording>(context.document.head());
}

bool Exporter::start(EditorContext& context, const output::ExportRequest& wish, int width, int height,
                     bool transparent) {
    if (running())
        return false;
    output::ExportRequest request = wish;
    request.threads = std::max(1, hardware_threads() - 1);
    request.told = std::make_shared<std::vector<std::string>>();
    const RecordingPtr recording = exported_recording(context);
    output::PictureLook look;
    look.camera = context.state.camera;
    look.options = view_options(context, recording->scene());
    look.width = width;
    look.height = height;
    look.background_top = context.theme.view_top;
    look.background_bottom = context.theme.view_bottom;
    look.transparent = transparent;
    // Lines as wide, against the picture, as on the screen.
    look.line_scale = context.state.scale * static_cast<float>(height) /
                      std::max(1.0f, static_cast<float>(context.state.view_height));
    std::shared_ptr<const output::MeasuredRows> measured;
    if (const MetricValues& values = context.metrics.current();
        values.scene == recording->scene_ptr() && values.frame_count() == recording->frame_count())
        measured = std::make_shared<const output::MeasuredRows>(values.rows);
    try {
        if (output::export_kind(request.kind).traits.draws && context.view == nullptr)
            throw_error(request.target.string(), "nothing can be drawn", "a graphics context");
        job_ = std::make_unique<output::ExportJob>(request, recording, look, measured);
    } catch (const std::exception& problem) {
        context.log.add(Severity::error, problem.what());
        failure_ = {request, problem.what()};
    }
    return true;
}

void Exporter::cancel() {
    if (job_ == nullptr)
        return;
    job_->cancel();
    given_up_.push_back(std::move(job_));
}

void Exporter::update(EditorContext& context) {
    for (const auto& job : given_up_)
        if (job->state() == State::cancelled || job->state() == State::failed)
            context.log.add(Severity::note,
                            "Export cancelled, nothing was written: " + job->request().target.string());
        else if (job->state() == State::done) // it was over before it heard of it
            context.log.add(Severity::note, "Exported " + job->request().target.string());
    std::erase_if(given_up_, [](const auto& job) { return job->state() != State::running; });
    if (job_ == nullptr)
        return;
    job_->draw(slice_seconds);
    if (job_->state() != State::running)
        end(context);
}

void Exporter::end(EditorContext& context) {
    const std::unique_ptr<output::ExportJob> job = std::move(job_);
    std::error_code error;
    if (job->state() == State::failed) {
        context.log.add(Severity::error, job->error());
        failure_ = {job->request(), job->error()};
    } else {
        context.log.add(Severity::note, "Exported " + fs::absolute(job->request().target, error).string());
        for (const std::string& sentence : *job->request().told)
            context.log.add(Severity::note, sentence);
    }
}

std::optional<double> Exporter::redraw_after() const {
    if (job_ != nullptr)
        return job_->drawn() < job_->total() ? 0.0 : 1.0 / 25;
    return given_up_.empty() ? std::nullopt : std::optional<double>(1.0 / 25);
}

} // namespace fascicle::editor
