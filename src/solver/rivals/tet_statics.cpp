#include "solver/rivals/tet_statics.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::solver {

namespace {

constexpr std::size_t chunk = 512;
std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

/// Sum of chunks in their order: the same for any number of threads.
template <class Term>
double ordered_sum(int threads, std::size_t n, const Term& term) {
    std::vector<double> sums((n + chunk - 1) / chunk, 0.0);
    parallel_for(threads, n, chunk, [&](std::size_t begin, std::size_t end) {
        double sum = 0.0;
        for (std::size_t i = begin; i < end; ++i)
            sum += term(i);
        sums[begin / chunk] = sum;
    });
    double total = 0.0;
    for (const double s : sums)
        total += s;
    return total;
}

} // namespace

TetStatics::TetStatics(const Points& rest, std::vector<Tet> tets, const std::vector<double>& weights,
                       const std::vector<Vec3>& fibres, const TetMaterial& material,
                       const StaticsSettings& settings)
    : rest_(rest), tets_(std::move(tets)), material_(material), settings_(settings) {
    std::vector<std::vector<int>> neighbours(rest.size());
    for (std::size_t t = 0; t < tets_.size(); ++t) {
        rest_shapes_.push_back(
            tet_shape(corners(t, rest_), weights[t], fibres.empty() ? Vec3(Vec3::Zero()) : fibres[t]));
        FASCICLE_ASSERT(rest_shapes_.back().volume > 0.0);
        rest_volume_ += rest_shapes_.back().volume;
        for (const int a : tets_[t])
            for (const int b : tets_[t])
                if (a != b)
                    neighbours[at(a)].push_back(b);
    }
    std::vector<int> starts{0}, all;
    for (std::size_t a = 0; a < rest.size(); ++a) {
        auto& row = neighbours[a];
        std::sort(row.begin(), row.end());
        row.erase(std::unique(row.begin(), row.end()), row.end());
        all.insert(all.end(), row.begin(), row.end());
        starts.push_back(static_cast<int>(all.size()));
    }
    matrix_ = BlockMatrix(starts, all);
    places_.resize(tets_.size());
    for (std::size_t t = 0; t < tets_.size(); ++t)
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = 0; j < 4; ++j)
                places_[t][4 * i + j] = matrix_.place(tets_[t][i], tets_[t][j]);
    shapes_ = rest_shapes_;
}

void TetStatics::set_active_length(double s) {
    shapes_ = rest_shapes_;
    for (TetShape& shape : shapes_)
        if (s != 1.0 && !shape.fibre.isZero(0.0)) {
            const Mat3 inverse = active_inverse(shape.fibre, s);
            for (Vec3& g : shape.gradients)
                g = inverse.transpose() * g;
        }
}

std::array<Vec3, 4> TetStatics::corners(std::size_t tet, const Points& x) const {
    const Tet& t = tets_[tet];
    return {x[at(t[0])], x[at(t[1])], x[at(t[2])], x[at(t[3])]};
}

Vec3 TetStatics::bound(const TetBinding& binding, const Points& x) const {
    const Tet& t = tets_[at(binding.tet)];
    Vec3 p = Vec3::Zero();
    for (std::size_t k = 0; k < 4; ++k)
        p += binding.weights[k] * x[at(t[k])];
    return p;
}

double TetStatics::growth(const Points& x) const {
    return ordered_sum(settings_.threads, tets_.size(), [&](std::size_t t) {
        return shapes_[t].volume * (deformation_gradient(shapes_[t], corners(t, x)).determinant() - 1.0);
    });
}

double TetStatics::volume_ratio(const Points& x) const {
    return 1.0 + growth(x) / rest_volume_;
}

double TetStatics::pressure_at(double growth) const {
    return volume_.stiffness * (1.0 + growth / rest_volume_ - volume_.ratio);
}

Eigen::VectorXd TetStatics::volume_gradient(const Points& x) const {
    Eigen::VectorXd slope = Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(x.size()));
    for (std::size_t t = 0; t < tets_.size(); ++t) {
        const Mat3 areas = shapes_[t].volume * cofactor(deformation_gradient(shapes_[t], corners(t, x)));
        for (std::size_t k = 0; k < 4; ++k)
            slope.segment<3>(3 * tets_[t][k]) += areas * shapes_[t].gradients[k];
    }
    for (std::size_t i = 0; i < fixed_.size(); ++i)
        if (fixed_[i] != 0)
            slope[static_cast<Eigen::Index>(i)] = 0.0;
    return slope;
}

/// Small beside every elastic force, large beside rounding.
double TetStatics::loose_stiffness() const {
    return 1e-3 * settings_.force_scale / std::cbrt(6.0 * rest_shapes_.front().volume);
}

double TetStatics::energy(const Points& x) const {
    double sum = ordered_sum(settings_.threads, tets_.size(), [&](std::size_t t) {
        const Mat3 f = deformation_gradient(shapes_[t], corners(t, x));
        return shapes_[t].volume * energy_density(material_, shapes_[t].fibre, f);
    });
    for (const TetPull& pull : pulls_)
        sum += 0.5 * pull.stiffness * (bound(pull.at, x) - pull.target).squaredNorm();
    for (const TetTouch& touch : touches_) {
        const double depth = std::max(0.0, touch.level - touch.out.dot(bound(touch.at, x)));
        sum += 0.5 * touch.stiffness * depth * depth;
    }
    if (volume_.stiffness > 0.0) {
        const double off = volume_ratio(x) - volume_.ratio;
        sum += 0.5 * volume_.stiffness * rest_volume_ * off * off;
    }
    for (std::size_t i = 0; i < loads_.size(); ++i)
        sum -= loads_[i].dot(x[i] - rest_[i]);
    for (std::size_t i = 0; i < loose_.size(); ++i)
        if (loose_[i] != 0 && !start_.empty())
            sum += 0.5 * loose_stiffness() * (x[i] - start_[i]).squaredNorm();
    return sum;
}

Eigen::VectorXd TetStatics::gradient(const Points& x) const {
    std::vector<std::array<Vec3, 4>> parts(tets_.size());
    const double pressure = volume_.stiffness > 0.0 ? pressure_at(growth(x)) : 0.0;
    parallel_for(settings_.threads, tets_.size(), chunk, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t)
            parts[t] = tet_gradient(material_, shapes_[t], deformation_gradient(shapes_[t], corners(t, x)),
                                    pressure);
    });
    Eigen::VectorXd g = Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(x.size()));
    const auto segment = [&](int node) { return g.segment<3>(3 * node); };
    for (std::size_t t = 0; t < tets_.size(); ++t)
        for (std::size_t k = 0; k < 4; ++k)
            segment(tets_[t][k]) += parts[t][k];
    const auto spread = [&](const TetBinding& binding, const Vec3& force) {
        for (std::size_t k = 0; k < 4; ++k)
            segment(tets_[at(binding.tet)][k]) += binding.weights[k] * force;
    };
    for (const TetPull& pull : pulls_)
        spread(pull.at, pull.stiffness * (bound(pull.at, x) - pull.target));
    for (const TetTouch& touch : touches_)
        if (const double depth = touch.level - touch.out.dot(bound(touch.at, x)); depth > 0.0)
            spread(touch.at, -touch.stiffness * depth * touch.out);
    for (std::size_t i = 0; i < loads_.size(); ++i)
        segment(static_cast<int>(i)) -= loads_[i];
    for (std::size_t i = 0; i < loose_.size(); ++i)
        if (loose_[i] != 0 && !start_.empty())
            segment(static_cast<int>(i)) += loose_stiffness() * (x[i] - start_[i]);
    for (std::size_t i = 0; i < fixed_.size(); ++i)
        if (fixed_[i] != 0)
            g[static_cast<Eigen::Index>(i)] = 0.0;
    return g;
}

void TetStatics::assemble(const Points& x, bool definite) {
    matrix_.clear();
    double pressure = 0.0;
    slope_.resize(0);
    if (volume_.stiffness > 0.0) {
        pressure = pressure_at(growth(x));
        slope_ = std::sqrt(volume_.stiffness / rest_volume_) * volume_gradient(x);
    }
    std::vector<Mat12> parts(std::min(tets_.size(), std::size_t{4096}));
    for (std::size_t first = 0; first < tets_.size(); first += parts.size()) {
        const std::size_t count = std::min(parts.size(), tets_.size() - first);
        parallel_for(settings_.threads, count, 64, [&](std::size_t begin, std::size_t end) {
            for (std::size_t t = first + begin; t < first + end; ++t)
                parts[t - first] =
                    tet_stiffness(material_, shapes_[t], deformation_gradient(shapes_[t], corners(t, x)),
                                  definite, pressure);
        });
        for (std::size_t t = first; t < first + count; ++t)
            for (int i = 0; i < 4; ++i)
                for (int j = 0; j < 4; ++j)
                    matrix_.add(places_[t][at(4 * i + j)], tets_[t][at(j)],
                                parts[t - first].block<3, 3>(3 * i, 3 * j));
    }
    const auto spread = [&](const TetBinding& binding, const Mat3& block) {
        const std::size_t t = at(binding.tet);
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = 0; j < 4; ++j)
                matrix_.add(places_[t][4 * i + j], tets_[t][j],
                            binding.weights[i] * binding.weights[j] * block);
    };
    for (const TetPull& pull : pulls_)
        spread(pull.at, pull.stiffness * Mat3::Identity());
    for (const TetTouch& touch : touches_)
        if (touch.level - touch.out.dot(bound(touch.at, x)) > 0.0)
            spread(touch.at, touch.stiffness * touch.out * touch.out.transpose());
    for (std::size_t i = 0; i < loose_.size(); ++i)
        if (loose_[i] != 0 && !start_.empty()) {
            const int node = static_cast<int>(i);
            matrix_.add(matrix_.place(node, node), node, loose_stiffness() * Mat3::Identity());
        }
    if (!fixed_.empty())
        matrix_.fix(fixed_);
}

const Eigen::SparseMatrix<double>& TetStatics::stiffness(const Points& x, bool definite) {
    assemble(x, definite);
    return matrix_.matrix();
}

std::size_t TetStatics::bytes() const {
    const auto entries = static_cast<std::size_t>(matrix_.matrix().nonZeros());
    const auto factor_entries =
        analysed_ ? static_cast<std::size_t>(factor_.matrixL().nestedExpression().nonZeros()) : 0;
    return bytes_of(rest_, tets_, rest_shapes_, shapes_, places_, pulls_, touches_, loads_, start_, fixed_,
                    loose_) +
           sizeof(double) * static_cast<std::size_t>(slope_.size() + solved_slope_.size()) +
           (entries + factor_entries) * (sizeof(double) + sizeof(int));
}

void TetStatics::factor() {
    if (!analysed_)
        factor_.analyzePattern(matrix_.matrix());
    analysed_ = true;
    // The definite tangent may be singular (a flattened tetrahedron, a body on nothing): a little on the diagonal.
    factor_.setShift(1e-9 * matrix_.mean_diagonal());
    factor_.factorize(matrix_.matrix());
    factored_ = factor_.info() == Eigen::Success;
    ++report_.factors;
}

Eigen::VectorXd TetStatics::precondition(const Eigen::VectorXd& right) const {
    Eigen::VectorXd z = factor_.solve(right);
    if (slope_.size() > 0)
        z -= slope_.dot(z) / (1.0 + slope_.dot(solved_slope_)) * solved_slope_;
    return z;
}

bool TetStatics::conjugate_gradients(const Eigen::VectorXd& right, double accuracy, int most,
                                     Eigen::VectorXd& step) {
    step.setZero(right.size());
    if (slope_.size() > 0)
        solved_slope_ = factor_.solve(slope_);
    Eigen::VectorXd r = right, z = precondition(r), p = z;
    double rz = r.dot(z);
    const double enough = accuracy * accuracy * right.squaredNorm();
    for (int i = 0; i < most && rz > 0.0; ++i) {
        Eigen::VectorXd kp = matrix_.matrix() * p;
        if (slope_.size() > 0)
            kp += slope_.dot(p) * slope_;
        const double curvature = p.dot(kp);
        if (!(curvature > 0.0))
            return i > 0;
        const double share = rz / curvature;
        step += share * p;
        r -= share * kp;
        ++report_.inner;
        if (r.squaredNorm() <= enough)
            return true;
        z = precondition(r);
        const double next = r.dot(z);
        p = z + next / rz * p;
        rz = next;
    }
    return !(rz > 0.0);
}

Eigen::VectorXd TetStatics::solve_linear(const Eigen::VectorXd& right, double accuracy) {
    Eigen::VectorXd step;
    if (factored_ && conjugate_gradients(right, accuracy, stale_after, step))
        return step;
    factor();
    if (!factored_) // not even definite: the steepest way down, scaled
        return right / std::max(matrix_.mean_diagonal(), 1e-300);
    if (!conjugate_gradients(right, accuracy, stale_after, step) && !(step.dot(right) > 0.0))
        step = right / std::max(matrix_.mean_diagonal(), 1e-300);
    return step;
}

const StaticsReport& TetStatics::solve(Points& x) {
    FASCICLE_ASSERT(x.size() == rest_.size());
    report_.steps = report_.inner = 0;
    double before = energy(x);
    Points next = x;
    for (;;) {
        const Eigen::VectorXd g = gradient(x);
        report_.residual = g.lpNorm<Eigen::Infinity>() / settings_.force_scale;
        report_.converged = report_.residual <= settings_.tolerance;
        if (report_.converged || report_.steps >= settings_.most_steps || !g.allFinite())
            break;
        ++report_.steps;
        assemble(x, true);
        // As exact as the step deserves (inexact Newton, Dembo, Eisenstat, Steihaug 1982): far from the end it is an
        // approximation anyhow, and at the end it need not be better than what is asked for.
        const double accuracy = std::clamp(0.2 * settings_.tolerance / report_.residual, 1e-10, 0.03);
        const Eigen::VectorXd step = solve_linear(-g, accuracy);
        const double slope = g.dot(step);
        double share = 1.0;
        bool moved = false;
        for (int halving = 0; halving < 30 && !moved; ++halving, share *= 0.5) {
            for (std::size_t i = 0; i < x.size(); ++i)
                next[i] = x[i] + share * step.segment<3>(3 * static_cast<Eigen::Index>(i));
            const double after = energy(next);
            // What rounding alone may add near the end.
            const double noise = 1e-13 * (std::abs(before) + settings_.force_scale * 1e-9);
            if (std::isfinite(after) && after <= before + 1e-4 * share * slope + noise) {
                moved = true;
                before = after;
                x.swap(next);
            }
        }
        if (!moved)
            break;
    }
    return report_;
}

} // namespace fascicle::solver
