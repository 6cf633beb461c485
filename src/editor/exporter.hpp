#pragma once
// The export under way: a slice of its pictures between two frames of the interface, the rest on a thread.

#include "editor/feature.hpp"
#include "output/export_job.hpp"

namespace fascicle::editor {

class Exporter : public Feature {
public:
    /// An export that failed, to be tried again under another name.
    struct Failure {
        output::ExportRequest request;
        std::string text; ///< one line
    };

    /// Starts with the recording that is shown and the view as it is now; what changes later does not show in it. One that is under way
    /// goes on, and this one does not start: false. size: of pictures; transparent: without a background.
    bool start(EditorContext& context, const output::ExportRequest& request, int width, int height,
               bool transparent);
    /// Null when nothing is exported.
    const output::ExportJob* job() const { return job_.get(); }
    bool running() const { return job_ != nullptr; }
    /// Nothing of it is left behind.
    void cancel();
    /// Once: the export that failed.
    std::optional<Failure> take_failure() { return std::exchange(failure_, std::nullopt); }

    void update(EditorContext& context) override;
    std::optional<double> redraw_after() const override;

    /// Of a frame of the interface that may go to drawing pictures.
    static constexpr double slice_seconds = 0.03;

private:
    void end(EditorContext& context);

    std::unique_ptr<output::ExportJob> job_;
    std::vector<std::unique_ptr<output::ExportJob>> given_up_; ///< told to stop, waited for without blocking
    std::optional<Failure> failure_;
};

/// What can be exported now: the recording that is shown; one without frames before any run.
RecordingPtr exported_recording(const EditorContext& context);

} // namespace fascicle::editor
