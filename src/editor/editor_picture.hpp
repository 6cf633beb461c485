#pragma once
// The whole editor as a picture, without a display.

#include "fascicle/base/job_control.hpp"
#include "fascicle/scene/recording.hpp"
#include "render/draw_list.hpp"
#include "view/colouring.hpp"

namespace fascicle::editor {

struct EditorPictureOptions {
    int width = 1280, height = 800; ///< pixels
    float scale = 1;                ///< of the interface
    bool dark = true;
    view::Colouring colouring = view::Colouring::anatomy; ///< of muscles
};

/// The editor with a recording and its playhead at `frame` (the last one there is, when that is not computed). Every
/// number in it is measured from the recording. Error when OSMesa is missing or the size is impossible.
render::Image render_editor_picture(RecordingPtr recording, int frame,
                                    const EditorPictureOptions& options = {});

/// Runs the whole scene first, so that the plots are complete. Reports the stages of the run.
render::Image render_editor_picture(const Scene& scene, int frame, const EditorPictureOptions& options = {},
                                    const JobControl& control = {});

} // namespace fascicle::editor
