#include "reproduce/run_pictures.hpp"

#include "fascicle/solver/soft_body_solver.hpp"
#include "output/run_pictures.hpp"

#include <algorithm>
#include <cmath>
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

} // namespace

void draw_pictures(const Recording& recording, const Experiment& experiment, MethodRun& row, bool is_short) {
    const bool own = row.method == solver_methods().front().name;
    std::vector<int> frames{100, 300};
    if (!is_short && (own || row.method == "classic"))
        frames = {0, 50, 100, 150, 200, 300};
    output::PictureOptions options;
    options.width = picture_width;
    options.height = picture_height;
    options.from = experiment.from;
    const auto draw = [&](const std::vector<int>& wanted, std::vector<Picture>& into) {
        output::Pictures pictures(recording, options);
        for (const int frame : wanted)
            if (const auto place = place_of(recording, frame, row.run.last_frame))
                into.push_back({"frame " + std::to_string(frame), pictures.draw(*place)});
    };
    draw(frames, row.pictures);
    if (own && row.run.fibres.count() > 0) {
        options.colouring = view::Colouring::fibres;
        draw({0, 100}, row.fibre_pictures);
    }
}

} // namespace fascicle::reproduce
