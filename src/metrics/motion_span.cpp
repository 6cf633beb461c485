// Which way a motion goes, and where it turns.

#include "fascicle/metrics/moment_arm.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/scene/model_motion.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle {

namespace {

/// Takes angles in order and remembers the one farthest from the first.
class FarthestAngle {
public:
    void add(double angle) {
        if (!started_)
            first_ = angle;
        started_ = true;
        if (std::abs(angle - first_) > std::abs(way_))
            way_ = angle - first_;
    }
    double sign() const { return way_ < 0.0 ? -1.0 : 1.0; }

private:
    bool started_ = false;
    double first_ = 0.0, way_ = 0.0;
};

/// Follows one direction until the angle has gone back by more than the tolerance.
class SpanFinder {
public:
    SpanFinder(std::span<const double> angles, double tolerance, double still)
        : angles_(angles), tolerance_(tolerance), still_(still) {}

    std::vector<MotionSpan> find() {
        for (std::size_t i = 1; i < angles_.size(); ++i)
            direction_ == 0.0 ? begin(i) : follow(i);
        if (direction_ != 0.0)
            spans_.push_back({start_, reached_});
        return std::move(spans_);
    }

private:
    /// No direction yet: from the last frame at either extreme, whichever is left far enough first.
    void begin(std::size_t i) {
        for (const double way : {1.0, -1.0}) {
            const std::size_t extreme = way > 0.0 ? lowest_ : highest_;
            if (way * (angles_[i] - angles_[extreme]) > tolerance_) {
                direction_ = way;
                start_ = extreme;
                reached_ = left_ = i;
                return;
            }
        }
        if (angles_[i] <= angles_[lowest_] + still_)
            lowest_ = i;
        if (angles_[i] >= angles_[highest_] - still_)
            highest_ = i;
    }

    void follow(std::size_t i) {
        const double ahead = direction_ * (angles_[i] - angles_[reached_]);
        if (ahead > still_)
            reached_ = left_ = i;
        else if (ahead >= -still_)
            left_ = i; // stands at the extreme, or is back there
        else if (ahead < -tolerance_) {
            spans_.push_back({start_, reached_});
            start_ = left_;
            direction_ = -direction_;
            reached_ = left_ = i;
        }
    }

    std::span<const double> angles_;
    double tolerance_, still_;
    std::vector<MotionSpan> spans_;
    double direction_ = 0.0;
    std::size_t lowest_ = 0, highest_ = 0; ///< last frames there, while there is no direction
    std::size_t start_ = 0;
    std::size_t reached_ = 0, left_ = 0; ///< first and last frame at the extreme in the direction
};

} // namespace

double flexion_sign(std::span<const double> angles_rad) {
    FarthestAngle farthest;
    for (const double angle : angles_rad)
        farthest.add(angle);
    return farthest.sign();
}

double flexion_sign(const Timeline& timeline) {
    // Linear between keys, so the keys within the motion and its ends are enough.
    FarthestAngle farthest;
    farthest.add(timeline.angle_rad(0));
    for (const AngleKey& key : timeline.angles)
        if (key.frame > 0 && key.frame < timeline.last_frame)
            farthest.add(key.angle_rad);
    farthest.add(timeline.angle_rad(timeline.last_frame));
    return farthest.sign();
}

double flexion_sign(const Scene& scene) {
    return model_motion_in_force(scene) != nullptr ? 1.0 : flexion_sign(scene.timeline);
}

std::vector<MotionSpan> motion_spans(std::span<const double> angles_rad) {
    for (std::size_t k = 0; k < angles_rad.size(); ++k)
        if (!std::isfinite(angles_rad[k]))
            throw_error("moment arms", "the joint angle of frame " + std::to_string(k) + " is not finite",
                        "an angle in radians");
    if (angles_rad.empty())
        return {};
    const auto [least, most] = std::minmax_element(angles_rad.begin(), angles_rad.end());
    const double range = *most - *least;
    if (!(range > 1e-7))
        return {};
    constexpr double half_degree = 0.0087266462599716477;
    return SpanFinder(angles_rad, std::min(half_degree, range / 50.0), 1e-9 * range).find();
}

} // namespace fascicle
