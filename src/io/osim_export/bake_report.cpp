#include "io/osim_export/bake_report.hpp"

#include "fascicle/anatomy/line_measure.hpp"
#include "fascicle/metrics/moment_arm.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fascicle::io {
namespace {

constexpr double mm = 1000;

/// The value half-way between places k and k + 1, of the cubic through the four nearest ones; the line between the two where places are too uneven
/// for that, or fewer.
double half_way(std::span<const double> x, std::span<const double> y, std::size_t k) {
    const double at = 0.5 * (x[k] + x[k + 1]);
    const std::size_t n = x.size();
    if (n >= 4) {
        const std::size_t first = std::min(k > 0 ? k - 1 : 0, n - 4);
        double least = std::numeric_limits<double>::infinity(), most = 0;
        for (std::size_t i = first; i < first + 3; ++i)
            least = std::min(least, x[i + 1] - x[i]), most = std::max(most, x[i + 1] - x[i]);
        if (least > 0.2 * most) {
            double sum = 0;
            for (std::size_t i = first; i < first + 4; ++i) {
                double weight = 1;
                for (std::size_t j = first; j < first + 4; ++j)
                    if (j != i)
                        weight *= (at - x[j]) / (x[i] - x[j]);
                sum += weight * y[i];
            }
            return sum;
        }
    }
    return 0.5 * (y[k] + y[k + 1]);
}

void raise(double& largest, double difference) {
    largest = std::max(largest, std::abs(difference));
}

} // namespace

double opensim_moment_arm(const LineModel& model, int muscle, int coordinate, const Posture& posture) {
    std::vector<double> rates;
    std::vector<Twist> twists;
    coordinate_rates(model.skeleton, posture.q, coordinate, rates);
    body_twists(model.skeleton, posture.q, rates, posture.poses, twists);
    const std::vector<PathPoint>& points = model.muscles[static_cast<std::size_t>(muscle)].points;
    const auto place = [&](const PathPoint& p, Vec3& velocity) {
        const Pose& pose = posture.poses[static_cast<std::size_t>(p.body)];
        Vec3 local = p.location, rate = Vec3::Zero();
        if (p.kind == PathPointKind::moving) {
            for (std::size_t c = 0; c < 3; ++c) {
                local[static_cast<Eigen::Index>(c)] = p.moves[c].value(posture.q);
                rate[static_cast<Eigen::Index>(c)] = p.moves[c].rate(posture.q, rates);
            }
            local = p.frame.apply(local);
            rate = p.frame.rotation * rate;
        }
        const Vec3 x = pose.apply(local);
        velocity = twists[static_cast<std::size_t>(p.body)].at(x) + pose.rotation * rate;
        return x;
    };
    double arm = 0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        if (points[i].body == points[i + 1].body)
            continue;
        Vec3 va, vb;
        const Vec3 a = place(points[i], va), b = place(points[i + 1], vb);
        arm += (b - a).stableNormalized().dot(va - vb);
    }
    return arm;
}

BakeReport::BakeReport(const LineModel& model, const BakedMotion& motion) : model_(model), motion_(motion) {
    std::vector<char> fitted(motion.values.size(), 0);
    const auto value = [&](int k) { return motion.values[static_cast<std::size_t>(k)]; };
    for (std::size_t i = 0; i < motion.fitted.size(); ++i) {
        const int k = motion.fitted[i];
        fitted[static_cast<std::size_t>(k)] = 1;
        if (i > 0)
            places_.push_back(0.5 * (value(motion.fitted[i - 1]) + value(k)));
        places_.push_back(value(k));
    }
    const auto posture = [&](double q) {
        Posture p;
        set_posture(model.skeleton, std::vector<double>(model.skeleton.coordinates.size(), q), p);
        return p;
    };
    for (const double q : places_)
        postures_.push_back(posture(q));
    for (std::size_t k = 0; k < fitted.size(); ++k)
        if (fitted[k] == 0) {
            other_frames_.push_back(static_cast<int>(k));
            other_postures_.push_back(posture(motion.values[k]));
        }
}

void BakeReport::measure(int muscle, const FibreCourse& course, const std::vector<int>& simulated,
                         OsimFibreReport& report) const {
    LinePathSolver solver(model_);
    std::vector<double> x;
    for (std::size_t s = 0; s < places_.size(); s += 2)
        x.push_back(places_[s]);
    const bool arms = !course.arms.empty();
    if (!arms)
        report.moment_arm_mm = report.exact_moment_arm_mm = report.opensim_moment_arm_mm =
            std::numeric_limits<double>::quiet_NaN();
    std::vector<double> lengths; // of the model, at the frames
    for (std::size_t s = 0; s < places_.size(); ++s) {
        const std::size_t k = s / 2;
        const bool between = s % 2 == 1;
        const LineMeasure line = measure_line(solver, muscle, arms ? 0 : -1, postures_[s]);
        const double length = between ? half_way(x, course.lengths, k) : course.lengths[k];
        raise(between ? report.length_between_mm : report.length_mm, mm * (line.length - length));
        if (arms) {
            const double arm = between ? half_way(x, course.arms, k) : course.arms[k];
            raise(report.exact_moment_arm_mm, mm * (line.moment_arm - arm));
            raise(report.opensim_moment_arm_mm,
                  mm * (opensim_moment_arm(model_, muscle, 0, postures_[s]) - arm));
        }
        if (between)
            continue;
        lengths.push_back(line.length);
        for (std::size_t i = 0; i < simulated.size(); ++i)
            if (simulated[i] >= 0)
                raise(
                    report.point_mm,
                    mm * (line.polyline.at(i) - course.at(k, static_cast<std::size_t>(simulated[i]))).norm());
    }
    if (arms) { // values go up with the flexion angle: sign 1
        const std::vector<double> run = excursion_arms(x, course.lengths, 1, 1),
                                  model = excursion_arms(x, lengths, 1, 1);
        for (std::size_t k = 0; k < run.size(); ++k)
            raise(report.moment_arm_mm, mm * (model[k] - run[k]));
    }
    if (other_frames_.empty())
        report.length_other_frames_mm = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 0; i < other_frames_.size(); ++i)
        raise(report.length_other_frames_mm,
              mm * (measure_line(solver, muscle, -1, other_postures_[i]).length -
                    course.all_lengths[static_cast<std::size_t>(other_frames_[i])]));
}

double BakeReport::bone_mm(const std::vector<Points>& corners_of_body, const BakedModel& written) const {
    double largest = 0;
    Posture posture;
    for (std::size_t k = 0; k < motion_.values.size(); ++k) {
        set_posture(model_.skeleton,
                    std::vector<double>(model_.skeleton.coordinates.size(), motion_.values[k]), posture);
        for (std::size_t b = 1; b < written.bodies.size(); ++b) {
            const int body = model_.skeleton.body_index(written.bodies[b].name);
            for (const Vec3& corner : corners_of_body[b])
                raise(largest, mm * (posture.poses.at(static_cast<std::size_t>(body)).apply(corner) -
                                     motion_.poses[k][b].apply(corner))
                                        .norm());
        }
    }
    return largest;
}

} // namespace fascicle::io
