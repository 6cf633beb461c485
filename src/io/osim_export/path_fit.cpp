#include "io/osim_export/path_fit.hpp"

#include "fascicle/metrics/moment_arm.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

namespace fascicle::io {
namespace {

using Matrix = Eigen::MatrixXd;

class PathFit {
public:
    PathFit(const FibreBaking& baking, const FibreCourse& course, const FibrePath& path)
        : baking_(baking), course_(course), path_(path), frames_(baking.places.size()) {
        for (std::size_t i = 0; i < path.points.size(); ++i)
            if (path.points[i].moving)
                moving_.push_back(i);
        samples_.resize(Eigen::Index(frames_), Eigen::Index(3 * moving_.size()));
        for (std::size_t m = 0; m < moving_.size(); ++m)
            for (std::size_t k = 0; k < frames_; ++k)
                samples_.block<1, 3>(Eigen::Index(k), Eigen::Index(3 * m)) =
                    baking.poses[k][body(moving_[m])].apply_inverse(simulated(k, moving_[m])).transpose();
        if (!course.arms.empty())
            target_.emplace(baking.places, course.lengths, course.arms, baking.tolerance);
    }

    /// Values at the knots, n x 3 per moving point, and how large the worst error is in tolerances.
    struct Result {
        Matrix values;
        double error = 0;
    };
    Result fit(const SplineFit& spline) {
        Result result{spline.fit(samples_), 0};
        if (target_)
            follow_target(spline, result.values);
        result.error = error(spline, result.values) / baking_.tolerance;
        return result;
    }

    void store(const SplineFit& spline, const Matrix& values, FibrePath& path) const {
        path.knots = spline.knots();
        for (std::size_t m = 0; m < moving_.size(); ++m)
            for (std::size_t c = 0; c < 3; ++c) {
                const auto column = values.col(Eigen::Index(3 * m + c));
                path.points[moving_[m]].at_knots[c].assign(column.data(), column.data() + column.size());
            }
    }

private:
    std::size_t body(std::size_t i) const { return static_cast<std::size_t>(path_.points[i].body); }

    Vec3 simulated(std::size_t k, std::size_t i) const {
        if (const int j = path_.simulated[i]; j >= 0)
            return course_.at(k, static_cast<std::size_t>(j));
        return 0.5 * (simulated(k, i - 1) + simulated(k, i + 1));
    }

    /// Points of the path in ground. row: of a spline matrix, at the place of the poses.
    void place(const std::vector<Pose>& poses, const Eigen::Ref<const Eigen::RowVectorXd>& row,
               const Matrix& values, Points& points) const {
        points.resize(path_.points.size());
        const Eigen::RowVectorXd local = row * values;
        std::size_t m = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const BakedPoint& point = path_.points[i];
            const Vec3 at =
                point.moving ? Vec3(local.segment<3>(Eigen::Index(3 * m)).transpose()) : point.location;
            m += point.moving ? 1 : 0;
            points[i] = poses[static_cast<std::size_t>(point.body)].apply(at);
        }
    }

    static double length(const Points& points) {
        double sum = 0;
        for (std::size_t i = 0; i + 1 < points.size(); ++i)
            sum += (points[i + 1] - points[i]).norm();
        return sum;
    }

    std::vector<Pose> poses_at(double q) const {
        std::vector<Pose> poses(baking_.poses.front().size());
        for (std::size_t b = 0; b < poses.size(); ++b)
            poses[b] = baking_.motion->pose(static_cast<int>(b), q);
        return poses;
    }

    void follow_target(const SplineFit& spline, Matrix& values) const {
        const std::vector<double>& knots = spline.knots();
        const std::size_t count = 4 * (knots.size() - 1) + 1;
        std::vector<double> places;
        std::vector<std::vector<Pose>> poses;
        for (std::size_t s = 0; s < count; ++s) {
            places.push_back(knots.front() + (knots.back() - knots.front()) * double(s) / double(count - 1));
            poses.push_back(poses_at(places.back()));
        }
        const Matrix basis = spline_matrix(knots, places);
        const Matrix products = basis * basis.transpose();
        const auto rows = Eigen::Index(count);
        Matrix gradients(rows, values.cols()); // of the length by the points' places in their bodies
        Eigen::VectorXd missing(rows);
        Points points;
        double before = std::numeric_limits<double>::infinity();
        for (int round = 0; round < 6; ++round) {
            for (Eigen::Index s = 0; s < rows; ++s) {
                place(poses[std::size_t(s)], basis.row(s), values, points);
                missing[s] = target_->length(places[std::size_t(s)]) - length(points);
                for (std::size_t m = 0; m < moving_.size(); ++m) {
                    const std::size_t i = moving_[m];
                    Vec3 g = Vec3::Zero();
                    if (i > 0)
                        g += (points[i] - points[i - 1]).stableNormalized();
                    if (i + 1 < points.size())
                        g -= (points[i + 1] - points[i]).stableNormalized();
                    gradients.block<1, 3>(s, Eigen::Index(3 * m)) =
                        (poses[std::size_t(s)][body(i)].rotation.transpose() * g).transpose();
                }
            }
            const double now = missing.cwiseAbs().maxCoeff();
            if (now < 0.01 * baking_.tolerance || now > 0.9 * before)
                break;
            before = now;
            Matrix normal = products.cwiseProduct(gradients * gradients.transpose());
            normal.diagonal().array() += 1e-6 * normal.trace() / double(count) + 1e-12;
            const Eigen::VectorXd pull = normal.ldlt().solve(missing);
            values += basis.transpose() * pull.asDiagonal() * gradients;
        }
    }

    /// The worst of length, points and moment arms (exact, and by excursion) at the frames; a length that is off by more than the tolerance counts ten times, so
    /// that a fit that keeps it is better than any that does not.
    double error(const SplineFit& spline, const Matrix& values) const {
        double worst = 0;
        Points points;
        std::vector<double> lengths_here;
        for (std::size_t k = 0; k < frames_; ++k) {
            place(baking_.poses[k], spline.matrix().row(Eigen::Index(k)), values, points);
            lengths_here.push_back(length(points));
            const double off = std::abs(lengths_here.back() - course_.lengths[k]);
            worst = std::max(worst, off > baking_.tolerance ? 10 * off : off);
            for (std::size_t m = 0; m < moving_.size(); ++m)
                worst = std::max(worst, (points[moving_[m]] - simulated(k, moving_[m])).norm());
        }
        if (course_.arms.empty())
            return worst;
        const std::vector<double> run = excursion_arms(baking_.places, course_.lengths, 1, 1),
                                  model = excursion_arms(baking_.places, lengths_here, 1, 1);
        for (std::size_t k = 0; k < frames_; ++k)
            worst = std::max(worst, std::abs(model[k] - run[k]));
        const double step = 1e-4; // radians; the error of the difference is far below a micrometre
        std::vector<double> places;
        for (const double q : baking_.places)
            places.insert(places.end(), {q - step, q + step});
        const Matrix rows = spline_matrix(spline.knots(), places);
        for (std::size_t k = 0; k < frames_; ++k) {
            double lengths[2];
            for (std::size_t side = 0; side < 2; ++side) {
                place(poses_at(places[2 * k + side]), rows.row(Eigen::Index(2 * k + side)), values, points);
                lengths[side] = length(points);
            }
            worst = std::max(worst, std::abs((lengths[1] - lengths[0]) / (2 * step) + course_.arms[k]));
        }
        return worst;
    }

    const FibreBaking& baking_;
    const FibreCourse& course_;
    const FibrePath& path_;
    std::size_t frames_;
    std::vector<std::size_t> moving_;
    Matrix samples_; ///< K x 3 per moving point, in their bodies
    std::optional<LengthTarget> target_;
};

} // namespace

void fit_path(const FibreBaking& baking, const FibreCourse& course, FibrePath& path) {
    PathFit fit(baking, course, path);
    const SplineFit* best_spline = nullptr;
    PathFit::Result best;
    int worse = 0;
    for (const SplineFit& spline : baking.fits) {
        PathFit::Result result = fit.fit(spline);
        if (best_spline == nullptr || result.error < best.error) {
            best = std::move(result);
            best_spline = &spline;
            worse = 0;
        } else if (++worse == 4) {
            break; // more knots follow the noise of the frames
        }
        if (best.error <= 0.95)
            break;
    }
    fit.store(*best_spline, best.values, path);
}

} // namespace fascicle::io
