// OpenSim's models.

#include "fascicle/anatomy/line_measure.hpp"
#include "fascicle/io/osim_file.hpp"
#include "fuzz/check.hpp"
#include "fuzz/targets.hpp"

#include <cmath>

namespace fascicle::fuzz {
namespace {

void check_model(const LineModel& model) {
    const Skeleton& skeleton = model.skeleton;
    const auto is_body = [&](int b) { return b >= 0 && b < static_cast<int>(skeleton.bodies.size()); };
    const auto is_coordinate = [&](int c) {
        return c >= 0 && c < static_cast<int>(skeleton.coordinates.size());
    };
    for (const Coordinate& c : skeleton.coordinates)
        FUZZ_CHECK(std::isfinite(c.default_value));
    for (const Joint& joint : skeleton.joints) {
        FUZZ_CHECK(is_body(joint.parent) && is_body(joint.child));
        for (const auto* axes : {&joint.rotations, &joint.translations})
            for (const JointAxis& axis : *axes)
                FUZZ_CHECK(std::abs(axis.axis.norm() - 1) < 1e-9);
    }
    for (const CoordinateCoupler& coupler : skeleton.couplers)
        FUZZ_CHECK(is_coordinate(coupler.dependent));
    for (const WrapObject& object : model.wrap_objects)
        FUZZ_CHECK(is_body(object.body));
    for (const LineMuscle& muscle : model.muscles) {
        FUZZ_CHECK(muscle.points.size() >= 2);
        for (const PathPoint& point : muscle.points)
            FUZZ_CHECK(is_body(point.body) &&
                       (point.kind != PathPointKind::conditional || is_coordinate(point.coordinate)));
        for (const PathWrap& wrap : muscle.wraps)
            FUZZ_CHECK(wrap.object >= 0 && wrap.object < static_cast<int>(model.wrap_objects.size()) &&
                       wrap.first >= 0 && wrap.last < static_cast<int>(muscle.points.size()));
    }
}

void fuzz_osim(std::string_view bytes) {
    OsimModel file;
    if (!reads("fuzz.osim", [&] { file = read_osim(bytes, "fuzz.osim"); }))
        return;
    const LineModel& model = file.model;
    check_model(model);
    const std::vector<double> values = model.skeleton.default_values();
    Posture posture;
    set_posture(model.skeleton, values, posture);
    FUZZ_CHECK(posture.poses.size() == model.skeleton.bodies.size());
    LinePathSolver solver(model);
    for (int m = 0; m < std::min(4, static_cast<int>(model.muscles.size())); ++m)
        measure_line(solver, m, values.empty() ? -1 : 0, posture);
}

} // namespace

std::vector<Target> opensim_targets() {
    return {
        {"osim", fuzz_osim, 8 * kB, "osim", "osim", 400, 4 * MB},
    };
}

} // namespace fascicle::fuzz
