#pragma once
// Muscles as lines: points fixed to bones, and surfaces that the line wraps over. Metres and radians, as in OpenSim's models.

#include "fascicle/anatomy/wrap_surface.hpp"
#include "fascicle/motion/skeleton.hpp"

#include <array>

namespace fascicle {

enum class PathPointKind {
    fixed,
    conditional, ///< there only while a coordinate lies in a range
    moving       ///< its place in the body depends on coordinates
};

struct PathPoint {
    std::string name;
    PathPointKind kind = PathPointKind::fixed;
    int body = 0;
    Vec3 location = Vec3::Zero();            ///< in the body's frame; not of moving points
    int coordinate = -1;                     ///< conditional: whose value counts
    double range_min = 0, range_max = 0;     ///< conditional: both included, and 1e-5 beyond, as OpenSim does
    std::array<CoordinateFunction, 3> moves; ///< moving: x, y, z in `frame`
    Pose frame;                              ///< moving: in the body's frame
};

/// A surface that belongs to a body, for any number of muscles.
struct WrapObject {
    std::string name;
    int body = 0;
    Pose pose; ///< of the surface's frame in the body
    bool active = true;
    WrapSurface surface;
};

/// "This muscle may wrap over that surface", between the points first and last (indices into LineMuscle::points, both
/// included).
struct PathWrap {
    int object = 0;
    int first = 0, last = 0;
};

struct LineMuscle {
    std::string name;
    std::string type;                 ///< as the model calls it, such as Thelen2003Muscle
    std::vector<PathPoint> points;    ///< from origin to insertion, two at least
    std::vector<PathWrap> wraps;      ///< in the order in which they are tried
    double max_isometric_force_n = 0; ///< 0: not told; the other three as well
    double optimal_fibre_length_m = 0;
    double tendon_slack_length_m = 0;
    double pennation_rad = 0; ///< at optimal fibre length
};

/// A plain value: the skeleton and its line muscles.
struct LineModel {
    std::string name;
    Skeleton skeleton;
    std::vector<WrapObject> wrap_objects;
    std::vector<LineMuscle> muscles;

    /// Index, or -1.
    int muscle_index(const std::string& name) const;
};

} // namespace fascicle
