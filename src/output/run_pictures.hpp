#pragma once
// Pictures of a run without a display: one camera for all frames, so that pictures can be laid side by side.

#include "fascicle/scene/recording.hpp"
#include "view/build_draw_list.hpp"
#include "view/render_picture.hpp"

#include <filesystem>

namespace fascicle::output {

struct PictureOptions {
    int width = 1280;
    int height = 800;
    std::optional<view::StandardView> from; ///< nothing: where most of muscles and motion is seen
    view::Colouring colouring = view::Colouring::anatomy; ///< of muscles
};

/// Names for `--view`, in the order of view::StandardView.
const std::vector<std::string>& standard_view_names();

/// The frame whose bones are furthest from their rest poses (largest way of a corner of a bone's box), the first of
/// several; 0 when nothing moves.
int most_flexed_frame(const Recording& recording);

class Pictures {
public:
    /// The recording must hold frame 0 and outlive this. Error when there is no OSMesa.
    Pictures(const Recording& recording, const PictureOptions& options);

    render::Image draw(int frame, int width, int height);
    render::Image draw(int frame) { return draw(frame, options_.width, options_.height); }
    /// Pictures without a background from here on.
    void set_transparent() { transparent_ = true; }
    /// The camera of all pictures of a shape, width over height.
    view::Camera camera(double aspect) const;
    const view::ViewOptions& options() const { return view_; }

private:
    void choose_side(int flexed);
    int muscle_pixels(int frame, const view::Camera& camera, int size);

    const Recording& recording_;
    PictureOptions options_;
    view::ViewOptions view_;
    view::DrawCache cache_;
    view::PictureRenderer renderer_;
    BoundingBox box_; ///< of everything that the run shows: one frame around all pictures
    view::Camera camera_;
    bool transparent_ = false;
};

/// rest.png, flexed.png, last.png and film_strip.png (seven frames from first to last) into a folder. Error naming the
/// file that cannot be written.
void write_run_pictures(const Recording& recording, const std::filesystem::path& folder);

void write_picture(const std::filesystem::path& path, const render::Image& image);

} // namespace fascicle::output
