#include "fascicle/scene/line_muscles.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/base/param_table.hpp"
#include "fascicle/geometry/bvh.hpp"
#include "fascicle/scene/line_posture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fascicle {

namespace {

constexpr double near_m = 5e-3; ///< ends this close to a bone in the median belong to it
constexpr double doubt_m = 10e-3;
constexpr double far_m = 50e-3; ///< farther from the bones than this: another frame or specimen

std::string rounded(double value, double steps) {
    return number_text(std::round(value * steps) / steps);
}

std::string without_side(const std::string& name) {
    return name.ends_with("_r") || name.ends_with("_l") ? name.substr(0, name.size() - 2) : name;
}

/// Where the ends of muscles are, per body, in its frame.
std::vector<Points> muscle_ends(const LineModel& model) {
    std::vector<Points> ends(model.skeleton.bodies.size());
    for (const LineMuscle& muscle : model.muscles)
        for (const PathPoint* point : {&muscle.points.front(), &muscle.points.back()})
            if (point->kind != PathPointKind::moving)
                ends[static_cast<std::size_t>(point->body)].push_back(point->location);
    return ends;
}

/// Index of the bone of the body's name, or -1.
int named_bone(const Scene& scene, const std::string& body) {
    if (const int exact = scene.bone_index(body); exact >= 0)
        return exact;
    for (std::size_t b = 0; b < scene.bones.size(); ++b)
        if (without_side(scene.bones[b].name) == without_side(body))
            return static_cast<int>(b);
    return -1;
}

class Placement {
public:
    Placement(const LineModel& model, const Scene& scene, std::string where)
        : model_(model), scene_(scene), where_(std::move(where)), ends_(muscle_ends(model)),
          used_(bodies_in_use(model)), units_(scene_units_per_metre(scene.unit)) {
        for (const Bone& bone : scene.bones)
            trees_.push_back(bone.mesh ? TriangleBvh(*bone.mesh) : TriangleBvh());
        for (const Body& body : model.skeleton.bodies)
            named_.push_back(named_bone(scene, body.name));
    }

    void choose_frame(LineMuscles& lines, std::vector<std::string>& notes) const;
    void match(LineMuscles& lines, std::vector<std::string>& notes) const;

private:
    std::size_t bodies() const { return used_.size(); }
    const std::string& body_name(std::size_t b) const { return model_.skeleton.bodies[b].name; }

    double distance(const Vec3& p_m, std::size_t bone) const {
        return trees_[bone].triangle_count() == 0
                   ? std::numeric_limits<double>::infinity()
                   : std::sqrt(trees_[bone].closest(units_ * p_m).squared_distance) / units_;
    }
    /// Of the ends of muscles on a body, metres; bone -1: each to its nearest one.
    std::vector<double> distances(std::size_t body, const Pose& rest, int bone) const {
        std::vector<double> found;
        for (const Vec3& p : ends_[body]) {
            double least = bone < 0 ? std::numeric_limits<double>::infinity()
                                    : distance(rest.apply(p), static_cast<std::size_t>(bone));
            for (std::size_t b = 0; bone < 0 && b < trees_.size(); ++b)
                least = std::min(least, distance(rest.apply(p), b));
            found.push_back(least);
        }
        return found;
    }
    /// Not the mean: a body may be several bones of the scene, or lines begin in the middle of a curved area.
    double median_distance(std::size_t body, const Pose& rest, int bone) const {
        std::vector<double> sorted = distances(body, rest, bone);
        std::sort(sorted.begin(), sorted.end());
        return sorted[(sorted.size() - 1) / 2];
    }
    /// Over all ends of muscles.
    double mean_distance(const std::vector<Pose>& rest) const {
        double sum = 0, count = 0;
        for (std::size_t b = 0; b < bodies(); ++b)
            for (const double d : distances(b, rest[b], named_[b])) {
                sum += d;
                ++count;
            }
        return count > 0 ? sum / count : 0.0;
    }

    const LineModel& model_;
    const Scene& scene_;
    std::string where_;
    std::vector<Points> ends_;
    std::vector<char> used_;
    double units_;
    std::vector<TriangleBvh> trees_;
    std::vector<int> named_; ///< per body: bone of its name, or -1
};

void Placement::choose_frame(LineMuscles& lines, std::vector<std::string>& notes) const {
    Posture posture;
    lines.rest_values = model_.skeleton.default_values();
    set_posture(model_.skeleton, lines.rest_values, posture);
    double best = std::numeric_limits<double>::infinity();
    std::string chosen;
    const auto consider = [&](std::vector<Pose> rest, const std::string& what) {
        const double mean = mean_distance(rest);
        if (!(mean < best - 1e-6))
            return;
        best = mean;
        lines.rest = std::move(rest);
        chosen = what;
    };
    consider(posture.poses,
             "the ground frame of the model is the scene's, its bodies as in its default posture");
    for (std::size_t k = 0; k < bodies(); ++k) {
        if (used_[k] == 0)
            continue;
        std::vector<Pose> rest;
        for (const Pose& pose : posture.poses)
            rest.push_back(posture.poses[k].inverse().after(pose));
        consider(std::move(rest), "the frame of body " + body_name(k) +
                                      " is the scene's, the others as in the model's default posture");
    }
    const std::string each = "the frame of every body is the scene's";
    consider(std::vector<Pose>(bodies()), each);
    if (!(best <= far_m))
        throw_error(where_,
                    "the ends of the muscles are " + rounded(1000 * best, 1) +
                        " mm from the bones in the mean",
                    "a model in the frame of the meshes, of the same specimen");
    notes.push_back(chosen + "; ends of muscles are " + rounded(1000 * best, 10) +
                    " mm from the bones in the mean" +
                    (best > doubt_m ? ", so far that the model may be of another specimen" : ""));
    if (chosen != each)
        return;
    fit_posture(model_.skeleton, used_, ends_, lines.rest, lines.rest_values);
    std::string values;
    const std::vector<double> start = model_.skeleton.default_values();
    for (std::size_t c = 0; c < start.size(); ++c) {
        const Coordinate& coordinate = model_.skeleton.coordinates[c];
        if (coordinate.kind == CoordinateKind::rotational && std::abs(lines.rest_values[c] - start[c]) > 1e-4)
            values += (values.empty() ? "" : ", ") + coordinate.name + ' ' +
                      rounded(lines.rest_values[c] * 180 / std::numbers::pi, 10);
    }
    if (!values.empty())
        notes.push_back("the scene's rest is the model's posture " + values + " degrees");
}

void Placement::match(LineMuscles& lines, std::vector<std::string>& notes) const {
    lines.bone_of_body.assign(bodies(), "");
    int still = -1;
    for (std::size_t b = 0; b < scene_.bones.size() && still < 0; ++b)
        if (b >= scene_.timeline.bone_tracks.size() || !scene_.timeline.bone_tracks[b].moves())
            still = static_cast<int>(b);
    std::string names;
    bool any = false;
    for (std::size_t body = 0; body < bodies(); ++body) {
        if (used_[body] == 0)
            continue;
        names += (names.empty() ? "" : ", ") + body_name(body);
        int bone = named_[body];
        std::string why = "by name";
        if (bone < 0 && !ends_[body].empty()) {
            double least = std::numeric_limits<double>::infinity();
            for (std::size_t b = 0; b < scene_.bones.size(); ++b)
                if (const double median = median_distance(body, lines.rest[body], static_cast<int>(b));
                    median < least) {
                    least = median;
                    bone = static_cast<int>(b);
                }
            why =
                "the nearest to the ends of its muscles, " + rounded(1000 * least, 10) + " mm in the median";
            if (!(least <= near_m))
                bone = -1;
        }
        any = any || bone >= 0;
        if (bone < 0) {
            bone = still;
            why = "for want of one of its name or near its muscles";
        }
        if (bone >= 0)
            lines.bone_of_body[body] = scene_.bones[static_cast<std::size_t>(bone)].name;
        notes.push_back("body " + body_name(body) +
                        (bone < 0 ? std::string(" stays") : " goes with bone " + lines.bone_of_body[body]) +
                        ", " + why);
    }
    if (!any)
        throw_error(where_,
                    "none of the bodies of its muscles (" + names + ") belongs to a bone of the scene",
                    "bodies named as bones, or ends of muscles within 5 mm of one");
}

} // namespace

double scene_units_per_metre(LengthUnit unit) {
    return 1000.0 / millimetres_per_unit(unit);
}

std::vector<char> bodies_in_use(const LineModel& model) {
    std::vector<char> used(model.skeleton.bodies.size(), 0);
    for (const LineMuscle& muscle : model.muscles) {
        for (const PathPoint& point : muscle.points)
            used[static_cast<std::size_t>(point.body)] = 1;
        for (const PathWrap& wrap : muscle.wraps)
            used[static_cast<std::size_t>(model.wrap_objects[static_cast<std::size_t>(wrap.object)].body)] =
                1;
    }
    return used;
}

LineMuscles place_line_muscles(std::shared_ptr<const LineModel> model, const Scene& scene,
                               const std::string& where, std::vector<std::string>& notes) {
    if (model->muscles.empty())
        throw_error(where, "the model has no muscles", "muscles with a path");
    if (scene.bones.empty())
        throw_error(where, "the scene has no bones that the model's could belong to", "bones");
    LineMuscles lines;
    const Placement placement(*model, scene, where);
    std::vector<std::string> said;
    placement.choose_frame(lines, said);
    placement.match(lines, said);
    lines.model = std::move(model);
    std::string coordinate;
    hinge_coordinate(lines, scene, &coordinate);
    said.push_back(coordinate);
    for (const std::string& note : said)
        notes.push_back("line muscles: " + note);
    return lines;
}

} // namespace fascicle
