#include "reproduce/run_pictures.hpp"

#include "fascicle/solver/soft_body_solver.hpp"
#include "reproduce/sweep.hpp"
#include "reproduce/words.hpp"
#include "view/build_draw_list.hpp"
#include "view/render_picture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace fascicle::reproduce {

namespace {

const int picture_width = 360, picture_height = 300;

/// Place in the recording of a frame of the paper's count; nothing when its surface was not kept.
std::optional<int> place_of(const Recording& recording, int paper_frame, int last_frame) {
    for (int k = 0; k < recording.frame_count(); ++k)
        if (std::abs(recording.frame(k)->index * paper_frames / last_frame - paper_frame) < 0.5)
            return k;
    return std::nullopt;
}

/// Draws frames of one run with one camera, on the muscle and not on the whole of the bones.
class Painter {
public:
    Painter(const Recording& recording, const Experiment& experiment)
        : recording_(recording),
          camera_(experiment.motion == MotionKind::squeeze ? view::WorldAxes::y_up : view::WorldAxes::lps) {
        view_.occlusion = true;
        view_.joint_axis = false;
        view_.line_muscles = false;
        BoundingBox all;
        for (int k = 0; k < recording.frame_count(); ++k)
            all.add(view::visible_bounds(view::subject_of(recording, k), view_));
        camera_.set_scene_bounds(all);
        if (experiment.motion == MotionKind::squeeze) {
            // Along the plates, which would hide the box from anywhere else.
            camera_.set_orthographic(true);
            camera_.look_from(view::StandardView::anterior);
            view_.bone_opacity = 0.35f;
        } else {
            camera_.look_from(experiment.from.value_or(view::StandardView::anterior));
            camera_.orbit_by(0, 8 * std::numbers::pi / 180);
        }
        // About the muscle at rest, so that all methods are seen from one place; a box squeezed to a tenth is three times as wide.
        BoundingBox shown;
        for (const Vec3& p : *recording.frame(0)->muscle_positions.front())
            if (p.allFinite())
                shown.add(p);
        const Vec3 border = (experiment.motion == MotionKind::squeeze ? 1.3 : 0.12) * (shown.max - shown.min);
        shown.add(shown.max + border);
        shown.add(shown.min - border);
        const double aspect = double(picture_width) / picture_height;
        camera_.frame(shown, aspect);
    }

    /// Muscles see-through, so that fibres are seen.
    void show_fibres() {
        view_.muscle_opacity = 0.3f;
        view_.attachments = false;
        view_.occlusion = false;
    }

    /// The model's lines in place of the fibres. A run that is read back has none.
    void show_lines(const std::shared_ptr<const LineMuscles>& lines) {
        show_fibres();
        view_.fibres = false;
        view_.line_muscles = true;
        auto scene = std::make_shared<Scene>(recording_.scene());
        scene->line_muscles = lines;
        with_lines_ = std::move(scene);
    }

    render::Image draw(int place) {
        const double aspect = double(picture_width) / picture_height;
        view::ViewSubject subject = view::subject_of(recording_, place);
        if (with_lines_ != nullptr)
            subject.scene = with_lines_;
        return renderer_.draw(view::build_draw_list(subject, view_, camera_.pose(aspect), cache_),
                              picture_width, picture_height);
    }

private:
    const Recording& recording_;
    ScenePtr with_lines_; ///< null: drawn as recorded
    view::ViewOptions view_;
    view::Camera camera_;
    view::DrawCache cache_;
    view::PictureRenderer renderer_;
};

} // namespace

void draw_pictures(const Recording& recording, const std::shared_ptr<const LineMuscles>& lines,
                   const Experiment& experiment, MethodRun& row, bool is_short) {
    const bool own = row.method == solver_methods().front().name;
    std::vector<int> frames{100, 300};
    if (is_sweep(experiment.motion))
        frames = {0, 100, 300}; // at rest, and on either side
    else if (!is_short && (own || row.method == "classic"))
        frames = {0, 50, 100, 150, 200, 300};
    Painter painter(recording, experiment);
    const auto caption = [&](int frame) {
        if (!is_sweep(experiment.motion))
            return "frame " + std::to_string(frame);
        const double angle =
            row.run.angle_deg.at(row.run.index_at(frame)) + sweep_turn(experiment.motion).rest_deg;
        return told_number(angle) + "\xC2\xB0 of " + to_text(experiment.motion);
    };
    const auto draw = [&](const std::vector<int>& wanted, std::vector<Picture>& into) {
        for (const int frame : wanted)
            if (const auto place = place_of(recording, frame, row.run.last_frame))
                into.push_back({caption(frame), painter.draw(*place)});
    };
    draw(frames, row.pictures);
    if (own && !is_sweep(experiment.motion) && row.run.fibres.count() > 0) {
        painter.show_fibres();
        draw({0, 100}, row.fibre_pictures);
        if (lines != nullptr && experiment.methods == MethodChoice::all) {
            painter.show_lines(lines);
            draw({0, 100}, row.line_pictures);
        }
    }
}

} // namespace fascicle::reproduce
