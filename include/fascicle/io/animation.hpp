#pragma once
// Bodies that move through numbered frames, as files for other programs hold them: one type for what is written and what is read back.

#include "fascicle/base/job_control.hpp"
#include "fascicle/base/pose.hpp"
#include "fascicle/io/mesh_data.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace fascicle {

enum class BodyKind { muscle, bone, fibres };

/// One body. It is rigid (poses, one a frame) or deforms (points). Vertices keep their number and order in all frames.
struct AnimatedBody {
    std::string name;
    BodyKind kind = BodyKind::muscle;
    std::vector<Tri> triangles;          ///< of a surface
    std::vector<std::vector<int>> lines; ///< of fibres
    Points rest;                         ///< rigid: before its pose; deforming: in the first frame
    std::vector<Pose> poses;             ///< rigid: one a frame; empty: deforms
    /// Deforming: its points in frame k, counted from 0; as many as `rest` has.
    std::function<void(std::size_t k, Points& points)> points;
};

/// Several bodies in the same frames.
struct Animation {
    std::string name;
    double millimetres_per_unit = 1; ///< 0: not known
    char up = 'z';                   ///< axis that points up: 'y' or 'z'
    std::vector<int> frames;         ///< numbers, ascending
    std::vector<double> seconds;     ///< one a frame, ascending
    std::vector<AnimatedBody> bodies;
    std::string provenance;         ///< what made it, a JSON object; may be empty
    std::vector<std::string> notes; ///< what a reader passed over, a sentence each

    std::size_t frame_count() const { return frames.size(); }
};

/// The body's points in frame k, whichever way it moves.
void points_in_frame(const AnimatedBody& body, std::size_t k, Points& points);

/// The first frame as one mesh, body after body, with a note when there is more than one body or frame.
MeshData first_frame(const Animation& animation);

/// Places of at most `most` + 1 frames out of `count`: every n-th from the first, n as small as it can be, and the last.
std::vector<std::size_t> spread_frames(std::size_t count, int most);

/// Names made different from each other by " 2", " 3" behind them, capital letters counting as small ones; an empty one becomes "body".
std::vector<std::string> unique_names(const std::vector<std::string>& names);
/// The same as names of files: separators and control characters become '_'.
std::vector<std::string> unique_file_names(const std::vector<std::string>& names);
/// The same as identifiers of ASCII letters, digits and '_' that do not begin with a digit; bytes of other characters become '_'.
std::vector<std::string> unique_identifiers(const std::vector<std::string>& names);

} // namespace fascicle
