#include "io/osim_export/bake_fibre.hpp"

#include "io/osim_export/path_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fascicle::io {
namespace {

constexpr double rigid = 2e-5; ///< metres: a point that stays this near to a place in a body is fixed to it
constexpr double coincident = 1e-5; ///< metres: OpenSim divides by the length of every segment
/// Shares of the tolerance that a straight fibre may use: what it is more than straight is not only noise.
constexpr double straight_share = 0.25;

struct Anchor {
    int body = 0;
    Vec3 location = Vec3::Zero();
    double deviation = 0; ///< largest distance from it
};

/// A point's mean place in a body.
Anchor anchor_in(const FibreBaking& baking, const FibreCourse& course, std::size_t j, std::size_t body) {
    const std::size_t frames = baking.places.size();
    Anchor anchor{static_cast<int>(body), Vec3::Zero(), 0};
    for (std::size_t k = 0; k < frames; ++k)
        anchor.location += baking.poses[k][body].apply_inverse(course.at(k, j)) / double(frames);
    for (std::size_t k = 0; k < frames; ++k)
        anchor.deviation =
            std::max(anchor.deviation,
                     (baking.poses[k][body].apply_inverse(course.at(k, j)) - anchor.location).norm());
    return anchor;
}

/// An end's place in the body that it is attached to, or that it moves least in.
Anchor anchor_of(const FibreBaking& baking, const FibreCourse& course, std::size_t j, int attached) {
    Anchor best;
    best.deviation = std::numeric_limits<double>::infinity();
    for (std::size_t b = baking.poses.front().size(); b-- > 0;) { // ground last: only where no bone will do
        const Anchor anchor = anchor_in(baking, course, j, b);
        if (anchor.deviation < best.deviation - 1e-9)
            best = anchor;
    }
    if (attached < 0)
        return best;
    const Anchor told = anchor_in(baking, course, j, static_cast<std::size_t>(attached));
    return told.deviation <= std::max(rigid, best.deviation) ? told : best;
}

BakedPoint fixed_point(const Anchor& anchor) {
    return {anchor.body, false, anchor.location, {}};
}

/// Whether the straight line between the ends is the fibre in all frames.
bool is_straight(const FibreBaking& baking, const FibreCourse& course, const Anchor& from, const Anchor& to) {
    const double allowed = straight_share * baking.tolerance;
    const std::size_t last = course.points - 1;
    for (std::size_t k = 0; k < baking.places.size(); ++k) {
        const Vec3 a = baking.poses[k][static_cast<std::size_t>(from.body)].apply(from.location);
        const Vec3 b = baking.poses[k][static_cast<std::size_t>(to.body)].apply(to.location);
        const double length = (b - a).norm();
        if (std::abs(length - course.lengths[k]) > allowed)
            return false;
        for (std::size_t j = 1; j < last; ++j) {
            const Vec3 p = course.at(k, j) - a;
            const double along = length > 0 ? std::clamp(p.dot(b - a) / length, 0.0, length) : 0.0;
            if ((p - along * (b - a) / std::max(length, 1e-12)).norm() > allowed)
                return false;
        }
        if (!course.arms.empty()) {
            const double q = baking.places[k], h = 1e-4;
            const auto chord = [&](double at) {
                return (baking.motion->pose(to.body, at).apply(to.location) -
                        baking.motion->pose(from.body, at).apply(from.location))
                    .norm();
            };
            if (std::abs((chord(q + h) - chord(q - h)) / (2 * h) + course.arms[k]) > allowed)
                return false;
        }
    }
    return true;
}

/// Longest segment of the rest pose's neighbours (first fitted frame), by its first index in `path`, from `begin` on.
std::size_t longest_segment(const FibreCourse& course, const std::vector<int>& path, std::size_t begin,
                            std::size_t end) {
    std::size_t longest = begin;
    double most = -1;
    for (std::size_t i = begin; i < end; ++i) {
        const double length = (course.at(0, static_cast<std::size_t>(path[i + 1])) -
                               course.at(0, static_cast<std::size_t>(path[i])))
                                  .norm();
        if (length > most)
            most = length, longest = i;
    }
    return longest;
}

/// Points that come closer to the one before than OpenSim bears are left out; ends stay.
std::vector<int> apart_points(const FibreCourse& course, std::size_t frames) {
    std::vector<int> kept{0};
    const auto close = [&](int a, int b) {
        for (std::size_t k = 0; k < frames; ++k)
            if ((course.at(k, static_cast<std::size_t>(a)) - course.at(k, static_cast<std::size_t>(b)))
                    .norm() < coincident)
                return true;
        return false;
    };
    const int last = static_cast<int>(course.points) - 1;
    for (int j = 1; j < last; ++j)
        if (!close(kept.back(), j) && !close(j, last))
            kept.push_back(j);
    kept.push_back(last);
    return kept;
}

} // namespace

FibreBaking fibre_baking(const BakedMotion& motion, double tolerance) {
    FibreBaking baking;
    baking.motion = &motion;
    baking.tolerance = tolerance;
    for (const int k : motion.fitted) {
        baking.places.push_back(motion.values[static_cast<std::size_t>(k)]);
        baking.poses.push_back(motion.poses[static_cast<std::size_t>(k)]);
    }
    // Evenly spaced knots, 2, 3, 4, 5, 6, 7, 8, 10, 12, 16, 20, ... up to as many as frames, or 160.
    const std::size_t most = std::min<std::size_t>(baking.places.size(), 160);
    for (std::size_t n = 2; n <= most; n = n < 8 ? n + 1 : n < 12 ? n + 2 : n + n / 4)
        baking.fits.emplace_back(n, baking.places);
    return baking;
}

FibrePath bake_fibre(const FibreBaking& baking, const FibreCourse& course) {
    const std::vector<int> kept = apart_points(course, baking.places.size());
    const std::size_t n = kept.size();
    const Anchor from = anchor_of(baking, course, 0, course.origin_body);
    const Anchor to = anchor_of(baking, course, course.points - 1, course.insertion_body);
    FibrePath path;
    if (from.deviation <= rigid && to.deviation <= rigid && is_straight(baking, course, from, to)) {
        path.points = {fixed_point(from), fixed_point(to)};
        path.simulated = {kept.front(), kept.back()};
        return path;
    }
    // Points that an end's bone carries are fixed, as the end.
    std::vector<Anchor> anchors(n);
    const auto carried = [&](std::size_t i, int body) {
        anchors[i] =
            anchor_in(baking, course, static_cast<std::size_t>(kept[i]), static_cast<std::size_t>(body));
        return anchors[i].deviation <= rigid;
    };
    std::size_t begin = 0, end = n; // of those that move
    while (begin < n && carried(begin, from.body))
        ++begin;
    while (end > begin && carried(end - 1, to.body))
        --end;
    // Bodies in turn, so that no segment with a moving end lies within one body.
    const int first_body = from.body, last_body = to.body;
    int other = last_body;
    if (other == first_body)
        other = baking.other_body != first_body ? baking.other_body : 0;
    std::vector<int> points(kept);
    std::vector<char> half_way(n, 0);
    if (begin < end) {
        const std::size_t moving = end - begin;
        const bool starts_fixed = begin > 0, ends_fixed = end < n;
        // A, then B A B ... and B at the end (A B for a fibre from A to B; A B A for one from A to A).
        const bool even = first_body != last_body;
        const std::size_t turns = moving + (starts_fixed ? 1 : 0) + (ends_fixed ? 1 : 0);
        if (starts_fixed && ends_fixed && (turns % 2 == 0) != even) {
            const std::size_t i = longest_segment(course, points, begin - 1, end);
            points.insert(points.begin() + static_cast<std::ptrdiff_t>(i) + 1, points[i]);
            half_way.insert(half_way.begin() + static_cast<std::ptrdiff_t>(i) + 1, 1);
            ++end;
        }
        bool first = !starts_fixed;
        if (!starts_fixed && ends_fixed) // from the far end backwards
            first = ((end - begin) % 2 == 0) == (last_body == first_body);
        for (std::size_t i = 0; i < points.size(); ++i) {
            BakedPoint point;
            if (i < begin) {
                point = fixed_point(anchors[i]);
            } else if (i >= end) {
                point = fixed_point(anchors[i - (points.size() - n)]);
            } else {
                point.moving = true;
                point.body = first ? first_body : other;
                first = !first;
            }
            path.points.push_back(std::move(point));
            path.simulated.push_back(half_way[i] != 0 ? -1 : points[i]);
        }
        fit_path(baking, course, path);
        return path;
    }
    for (std::size_t i = 0; i < n; ++i) {
        path.points.push_back(fixed_point(anchors[i]));
        path.simulated.push_back(kept[i]);
    }
    return path;
}

} // namespace fascicle::io
