#include "fascicle/anatomy/geodesic_path.hpp"

#include "fascicle/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fascicle {
namespace {

constexpr int most_sweeps = 1500; // a level
constexpr std::size_t most_points = 20000;
constexpr int most_rounds = 40; // a corner is halved each time

double length_of(const Points& points) {
    double length = 0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
        length += (points[i + 1] - points[i]).norm();
    return length;
}

struct Touch {
    int obstacle = -1;
    BoneObstacle::Foot foot; ///< in the string's frame
};

class String {
public:
    String(std::span<const PlacedObstacle> obstacles, double clearance)
        : obstacles_(obstacles), clearance_(clearance) {}

    /// Nearest obstacle of x.
    Touch nearest(const Vec3& x) const {
        Touch best;
        best.foot.distance = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < obstacles_.size(); ++k) {
            const Pose& pose = obstacles_[k].pose;
            const BoneObstacle::Foot foot = obstacles_[k].bone->foot(pose.apply_inverse(x));
            if (foot.distance < best.foot.distance)
                best = {static_cast<int>(k),
                        {foot.distance, pose.apply(foot.point), pose.rotation * foot.outward}};
        }
        return best;
    }
    /// Moves x out to `distance` of what is nearer. Between two bones it takes a few turns. Returns what it rests on (moved or
    /// not), or -1.
    int keep_out(Vec3& x, double distance) const {
        int touching = -1;
        for (int turn = 0; turn < 4; ++turn) {
            const Touch touch = nearest(x);
            if (touch.obstacle < 0 || touch.foot.distance > distance * (1 + 1e-6))
                break;
            touching = touch.obstacle;
            if (touch.foot.distance >= distance * (1 - 1e-9))
                break;
            x = touch.foot.point + distance * touch.foot.outward;
        }
        return touching;
    }

    void start(Points points) {
        points_ = std::move(points);
        const std::size_t n = points_.size();
        touching_.assign(n, -1);
        free_.assign(n, {Vec3::Zero(), -1.0});
        for (std::size_t i = 1; i + 1 < n; ++i)
            touching_[i] = keep_out(points_[i], clearance_);
    }
    void halve() {
        Points finer;
        for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
            finer.push_back(points_[i]);
            finer.push_back((points_[i] + points_[i + 1]) / 2);
        }
        finer.push_back(points_.back());
        start(std::move(finer));
    }
    /// Sweeps until nothing moves by more than a 1e-6th of a step. No point goes further than half a step at once, so that none
    /// is led out on the wrong side of a bone that is thicker than that.
    void tighten() {
        const std::size_t n = points_.size();
        const double omega =
            std::min(1.85, 2 / (1 + std::sin(std::numbers::pi / static_cast<double>(n - 1))));
        for (int sweep = 0; sweep < most_sweeps; ++sweep) {
            ++sweeps_;
            const double furthest = length_of(points_) / static_cast<double>(2 * (n - 1));
            double moved = 0, total = 0;
            for (std::size_t k = 1; k + 1 < n; ++k) {
                const std::size_t i = sweep % 2 == 0 ? k : n - 1 - k;
                const Vec3 before = points_[i];
                Vec3 step =
                    (sweep % 16 == 15 ? 1.0 : omega) * ((points_[i - 1] + points_[i + 1]) / 2 - before);
                if (const double size = step.norm(); size > furthest)
                    step *= furthest / size;
                place(i, before + step);
                moved = std::max(moved, (points_[i] - before).norm());
                total += (points_[i + 1] - points_[i]).norm();
            }
            if (moved < 1e-6 * total / static_cast<double>(n))
                break;
        }
    }
    /// Puts a point, led out, where a segment that meets a bone is deepest. True when there was one.
    bool refine() {
        Points finer{points_.front()};
        for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
            const Vec3 &a = points_[i], &b = points_[i + 1];
            if (meets(a, b)) {
                Vec3 deepest = (a + b) / 2;
                double least = nearest(deepest).foot.distance;
                constexpr int samples = 12;
                for (int k = 1; k < samples; ++k) {
                    const Vec3 x = a + (static_cast<double>(k) / samples) * (b - a);
                    if (const double here = nearest(x).foot.distance; here < least) {
                        least = here;
                        deepest = x;
                    }
                }
                finer.push_back(deepest);
            }
            finer.push_back(b);
        }
        if (finer.size() == points_.size())
            return false;
        start(std::move(finer));
        return true;
    }
    /// Takes out points that the string does not need to stay clear of the bones: over them it gets shorter.
    void pull_taut() {
        for (bool any = true; any;) {
            any = false;
            for (std::size_t i = 1; i + 1 < points_.size();) {
                if (meets(points_[i - 1], points_[i + 1])) {
                    ++i;
                    continue;
                }
                points_.erase(points_.begin() + static_cast<std::ptrdiff_t>(i));
                touching_.erase(touching_.begin() + static_cast<std::ptrdiff_t>(i));
                any = true;
            }
        }
    }
    /// Whether every inner point is outside; with refine() == false: whether the whole string is.
    bool points_are_outside() const {
        return std::all_of(points_.begin() + 1, points_.end() - 1,
                           [this](const Vec3& x) { return !(nearest(x).foot.distance <= 0); });
    }

    const Points& points() const { return points_; }
    const std::vector<int>& touching() const { return touching_; }
    int sweeps() const { return sweeps_; }

private:
    bool meets(const Vec3& a, const Vec3& b) const {
        return std::any_of(obstacles_.begin(), obstacles_.end(), [&](const PlacedObstacle& obstacle) {
            return obstacle.bone->meets(obstacle.pose.apply_inverse(a), obstacle.pose.apply_inverse(b));
        });
    }
    /// A ball in which nothing is nearer than the clearance.
    struct FreeBall {
        Vec3 centre;
        double radius;
    };
    void place(std::size_t i, const Vec3& x) {
        points_[i] = x;
        touching_[i] = -1;
        if ((x - free_[i].centre).norm() < free_[i].radius)
            return;
        const Touch touch = nearest(x);
        if (touch.obstacle < 0 || touch.foot.distance >= clearance_) {
            free_[i] = {x, touch.foot.distance - clearance_};
            return;
        }
        touching_[i] = keep_out(points_[i], clearance_);
    }

    std::span<const PlacedObstacle> obstacles_;
    double clearance_;
    Points points_;
    std::vector<int> touching_;
    std::vector<FreeBall> free_;
    int sweeps_ = 0;
};

Points straight(const Vec3& p, const Vec3& q, int segments) {
    Points points;
    for (int i = 0; i <= segments; ++i)
        points.push_back(p + (static_cast<double>(i) / segments) * (q - p));
    return points;
}

/// A string from before with new ends, in equal steps: what the ends have moved by fades out along it.
Points adapted(const Points& guess, const Vec3& p, const Vec3& q, int segments) {
    const double length = length_of(guess);
    Points points;
    std::size_t piece = 0;
    double passed = 0; // up to the start of the piece
    for (int i = 0; i <= segments; ++i) {
        const double wanted = length * i / segments;
        double here = (guess[piece + 1] - guess[piece]).norm();
        while (piece + 2 < guess.size() && passed + here < wanted) {
            passed += here;
            ++piece;
            here = (guess[piece + 1] - guess[piece]).norm();
        }
        const double share = here > 0 ? std::min(1.0, (wanted - passed) / here) : 0.0;
        points.push_back(guess[piece] + share * (guess[piece + 1] - guess[piece]));
    }
    const Vec3 at_start = p - guess.front(), at_end = q - guess.back();
    for (int i = 0; i <= segments; ++i) {
        const double share = static_cast<double>(i) / segments;
        points[static_cast<std::size_t>(i)] += (1 - share) * at_start + share * at_end;
    }
    points.front() = p;
    points.back() = q;
    return points;
}

/// Pulls the string tight and bends it round what its chords cut. False: something of it stays inside.
bool lead_round(String& string, const Vec3& from, const Vec3& to, int segments, const Points& guess) {
    if (guess.size() > 1) {
        string.start(adapted(guess, from, to, segments));
        string.tighten();
    } else {
        int coarse = segments;
        while (coarse % 2 == 0 && coarse > 5)
            coarse /= 2;
        string.start(straight(from, to, coarse));
        string.tighten();
        for (; coarse < segments; coarse *= 2) {
            string.halve();
            string.tighten();
        }
    }
    bool low = true;
    for (int round = 0; round < most_rounds && low && string.points().size() < most_points; ++round)
        low = string.refine();
    return !low && string.points_are_outside();
}

} // namespace

GeodesicPath geodesic_path(const Vec3& p, const Vec3& q, std::span<const PlacedObstacle> obstacles,
                           const GeodesicOptions& options, const Points& guess) {
    if (options.segments < 2 || options.segments > 1000 || !(options.clearance > 0) ||
        !std::isfinite(options.clearance))
        throw_error("geodesic path", "cannot be made of " + std::to_string(options.segments) + " segments",
                    "2 to 1000 segments and a clearance above 0", ErrorKind::usage);
    if (!p.allFinite() || !q.allFinite())
        throw_error("geodesic path", "an end is not a finite point", "finite coordinates", ErrorKind::usage);
    String string(obstacles, options.clearance);
    GeodesicPath path;
    Vec3 from = p, to = q;
    const int on_start = string.keep_out(from, options.clearance),
              on_end = string.keep_out(to, options.clearance);
    path.start_depth = (from - p).norm();
    path.end_depth = (to - q).norm();
    // Caught in a bone: smaller steps may not be.
    path.clear = lead_round(string, from, to, options.segments, guess) ||
                 lead_round(string, from, to, 3 * options.segments, guess);
    if (path.clear)
        string.pull_taut();

    path.points = string.points();
    path.touching = string.touching();
    path.touching.front() = on_start;
    path.touching.back() = on_end;
    if (path.start_depth > 0) {
        path.points.insert(path.points.begin(), p);
        path.touching.insert(path.touching.begin(), on_start);
    }
    if (path.end_depth > 0) {
        path.points.push_back(q);
        path.touching.push_back(on_end);
    }
    path.length = length_of(path.points);
    path.sweeps = string.sweeps();
    return path;
}

} // namespace fascicle
