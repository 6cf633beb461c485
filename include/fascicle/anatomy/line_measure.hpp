#pragma once
// What is told of a line muscle at one posture: as its model has it, and as a string over bones.

#include "fascicle/anatomy/geodesic_path.hpp"
#include "fascicle/anatomy/line_path.hpp"

#include <memory>
#include <optional>

namespace fascicle {

/// A bone's surface that goes with a body; mesh in the body's frame, metres.
struct BodyObstacle {
    int body = 0;
    std::shared_ptr<const BoneObstacle> bone;
};

struct LineMeasure {
    double length = 0;     ///< metres
    double moment_arm = 0; ///< metres, positive: pulls the coordinate up; 0 without a coordinate
    Points polyline;       ///< ground, for drawing
};

/// coordinate: index, or -1.
LineMeasure measure_line(LinePathSolver& solver, int muscle, int coordinate, const Posture& posture);

/// The muscle as a string from its first point to its last one over bones instead of along its points and wraps: they only
/// tell where it starts from (the side of the bones that it lies on). line: of measure_line at the same posture. Its moment
/// arm is exact for the string that is found: points go with the bones that they rest on.
struct StringMeasure {
    GeodesicPath path; ///< ground, metres
    double moment_arm = 0;
};
StringMeasure measure_string(const LineModel& model, int muscle, int coordinate, const Posture& posture,
                             const LineMeasure& line, std::span<const BodyObstacle> obstacles,
                             const GeodesicOptions& options = {});

} // namespace fascicle
