#pragma once
// The experiments of Cervenka & Kohout 2020 as rows: a further one is a row of experiments().

#include "fascicle/base/types.hpp"
#include "view/camera.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace fascicle::reproduce {

/// Which methods run an experiment.
enum class MethodChoice {
    all,      ///< every row of solver_methods()
    first,    ///< the program's own: solver_methods().front()
    published ///< `classic`, the published program step by step
};

/// How the solids of an experiment move; the paper's 300 frames are 100 there, 100 back, 100 at rest.
enum class MotionKind {
    flexion,   ///< the moving bone turns about an axis in x by 1 rad forwards (a negative angle)
    squeeze,   ///< the first bone comes down in y by 90 units, to a tenth of the gap
    adduction, ///< to 40 degrees of adduction, and on to 40 of abduction
    rotation   ///< to 30 degrees of internal rotation, and on to 30 of external
};
const char* to_text(MotionKind motion); ///< "hip flexion", ...
/// Through rest to the other side: for moment arms, as Modenese & Kohout 2020 (Table 2) have them. Not in the paper.
inline bool is_sweep(MotionKind motion) {
    return motion == MotionKind::adduction || motion == MotionKind::rotation;
}

struct Experiment {
    std::string key;     ///< in files and on the command line, unique
    std::string title;   ///< a heading
    std::string figures; ///< of the paper, e.g. "3, 4, 12"; empty: not in it
    std::string muscle;  ///< its name: that of the muscle's file, and of the embedded scene's muscle
    /// Names of the files it needs: muscle, bones that stay, bones that move.
    std::string muscle_file;
    std::vector<std::string> fixed_bones, moving_bones;
    /// Used when they are there.
    std::string attachments, surface_fibres, line_model;
    std::string stand_in;        ///< embedded scene that takes the place without data; empty: there is none
    std::string stand_in_muscle; ///< the muscle of it that counts, when it has another name
    std::optional<view::StandardView>
        from; ///< the side that the paper's pictures show; nothing: where most is seen
    MotionKind motion = MotionKind::flexion;
    Vec3 centre =
        Vec3(143.86, 243.37, -432.53); ///< of the hip joint, data's millimetres (a sphere fitted to the head)
    MethodChoice methods = MethodChoice::all;
    std::string fibres = "none"; ///< fibres.method
    std::string published;       ///< key of published_marks(); empty: none
    bool flexor = false;         ///< shortens in flexion, as the hip's flexors do
};

/// In the order of the report.
const std::vector<Experiment>& experiments();
/// Null when there is none.
const Experiment* find_experiment(const std::string& key);

} // namespace fascicle::reproduce
