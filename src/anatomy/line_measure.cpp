#include "fascicle/anatomy/line_measure.hpp"

namespace fascicle {

LineMeasure measure_line(LinePathSolver& solver, int muscle, int coordinate, const Posture& posture) {
    LineMeasure line;
    line.length = solver.solve(muscle, posture).length;
    if (coordinate >= 0)
        line.moment_arm = solver.moment_arm(coordinate, posture);
    solver.draw(posture, line.polyline);
    return line;
}

StringMeasure measure_string(const LineModel& model, int muscle, int coordinate, const Posture& posture,
                             const LineMeasure& line, std::span<const BodyObstacle> obstacles,
                             const GeodesicOptions& options) {
    std::vector<PlacedObstacle> placed;
    for (const BodyObstacle& obstacle : obstacles)
        placed.push_back({obstacle.bone.get(), posture.poses[static_cast<std::size_t>(obstacle.body)]});
    StringMeasure result;
    result.path = geodesic_path(line.polyline.front(), line.polyline.back(), placed, options, line.polyline);
    if (coordinate < 0)
        return result;
    const std::vector<PathPoint>& points = model.muscles[static_cast<std::size_t>(muscle)].points;
    std::vector<int> bodies;
    for (const int touching : result.path.touching)
        bodies.push_back(touching >= 0 ? obstacles[static_cast<std::size_t>(touching)].body : 0);
    // The ends belong to their own bodies, whatever lies next to them, and so do the points that lead out of a bone there.
    bodies.front() = points.front().body;
    bodies.back() = points.back().body;
    if (result.path.start_depth > 0)
        bodies[1] = points.front().body;
    if (result.path.end_depth > 0)
        bodies[bodies.size() - 2] = points.back().body;
    std::vector<double> rates;
    std::vector<Twist> twists;
    coordinate_rates(model.skeleton, posture.q, coordinate, rates);
    body_twists(model.skeleton, posture.q, rates, posture.poses, twists);
    result.moment_arm = polyline_moment_arm(result.path.points, bodies, twists);
    return result;
}

} // namespace fascicle
