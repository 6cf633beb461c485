#include "anatomy/fibres/template_fit.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace fascicle {

namespace {

constexpr double quarter_turn = 1.5707963267948966;

Points thinned(const Points& points, std::size_t most) {
    const std::size_t step = (points.size() + most - 1) / most;
    Points some;
    for (std::size_t i = 0; i < points.size(); i += step)
        some.push_back(points[i]);
    return some;
}

/// Outlines where there are any, else attached vertices.
Points landmarks(const FibreProblem& problem, AttachmentKind kind) {
    Points all;
    for (const AttachmentPatch& patch : problem.patches) {
        if (patch.kind != kind)
            continue;
        if (!patch.outline.empty())
            all.insert(all.end(), patch.outline.begin(), patch.outline.end());
        else
            for (const int v : patch.vertices)
                all.push_back(problem.surface->positions[static_cast<std::size_t>(v)]);
    }
    return all;
}

Vec3 mean_of(const Points& points) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& p : points)
        sum += p / double(points.size());
    return sum;
}

double nearest_distance(const Vec3& p, const Points& to) {
    double best = std::numeric_limits<double>::infinity();
    for (const Vec3& q : to)
        best = std::min(best, (p - q).squaredNorm());
    return std::sqrt(best);
}

/// Reversed bits as a fraction, and the second Sobol sequence (primitive polynomial x + 1): direction numbers
/// m_k = m_k-1 xor 2 m_k-1.
Vec2 sobol(std::uint32_t index) {
    std::uint32_t first = 0, second = 0;
    std::uint32_t direction = 1u << 31;
    for (std::uint32_t bit = 0; bit < 32; ++bit, direction ^= direction >> 1)
        if (((index >> bit) & 1u) != 0) {
            first ^= 1u << (31 - bit);
            second ^= direction;
        }
    return {first / 4294967296.0, second / 4294967296.0};
}

} // namespace

std::vector<Vec2> fibre_seeds(int count) {
    std::vector<Vec2> seeds;
    const auto side = static_cast<int>(std::lround(std::sqrt(double(count))));
    if (side * side == count) {
        for (int i = 0; i < count; ++i)
            seeds.emplace_back((i / side + 0.5) / side, (i % side + 0.5) / side);
        return seeds;
    }
    int cells = 1;
    while (cells < count)
        cells *= 2;
    // Every coordinate of the first 2^k points is a multiple of 1 / 2^k: half of that keeps off the border.
    for (int i = 0; i < count; ++i)
        seeds.emplace_back(sobol(static_cast<std::uint32_t>(i)) + Vec2::Constant(0.5 / cells));
    return seeds;
}

Points fibre_in_cube(const FibreTemplate& fibre_template, double r, double s, int segments) {
    Points line;
    const int pieces = std::max(64, 2 * segments);
    const auto add = [&](const Vec3& p) {
        if (line.empty() || (p - line.back()).norm() > 1e-12)
            line.push_back(p);
    };
    const Vec3 first = fibre_template.point(r, s, 0), last = fibre_template.point(r, s, 1);
    add({first.x(), 0, first.z()});
    for (int i = 0; i <= pieces; ++i)
        add(fibre_template.point(r, s, double(i) / pieces));
    add({last.x(), 1, last.z()});
    std::vector<double> walked{0.0};
    for (std::size_t i = 1; i < line.size(); ++i)
        walked.push_back(walked.back() + (line[i] - line[i - 1]).norm());
    Points points;
    std::size_t k = 0;
    for (int j = 0; j <= segments; ++j) {
        const double target = walked.back() * j / segments;
        while (k + 2 < line.size() && walked[k + 1] < target)
            ++k;
        const double share = std::clamp((target - walked[k]) / (walked[k + 1] - walked[k]), 0.0, 1.0);
        points.push_back((1.0 - share) * line[k] + share * line[k + 1]);
    }
    return points;
}

TemplateFrame fit_template(const FibreProblem& problem, const FibreTemplate& fibre_template) {
    const std::array<Points, 2> marks{landmarks(problem, AttachmentKind::origin),
                                      landmarks(problem, AttachmentKind::insertion)};
    Points surface;
    for (const Tri& t : problem.surface->triangles)
        surface.push_back(problem.surface->positions[static_cast<std::size_t>(t[0])]);
    surface = thinned(surface, 2000);
    Vec3 axis = mean_of(marks[1]) - mean_of(marks[0]);
    const Vec3 middle = mean_of(surface);
    if (!(axis.norm() > 1e-6 * (surface.front() - middle).norm())) {
        Mat3 covariance = Mat3::Zero();
        for (const Vec3& p : surface)
            covariance += (p - middle) * (p - middle).transpose();
        axis = Eigen::SelfAdjointEigenSolver<Mat3>(covariance).eigenvectors().col(2);
    }
    axis.normalize();
    const std::array<Points, 2> some{thinned(marks[0], 48), thinned(marks[1], 48)};
    std::array<Points, 2> ends;
    for (const double r : {0.0, 0.5, 1.0})
        for (const double s : {0.0, 0.5, 1.0}) {
            ends[0].push_back(fibre_template.point(r, s, 0));
            ends[1].push_back(fibre_template.point(r, s, 1));
        }
    const Vec3 side = axis.unitOrthogonal(), other = axis.cross(side);
    TemplateFrame best_frame;
    double best = std::numeric_limits<double>::infinity();
    for (const double mirror : {1.0, -1.0})
        for (int turn = 0; turn < 4; ++turn)
            for (int rotation = 0; rotation < 10; ++rotation) {
                const double angle = quarter_turn * (turn + rotation / 11.0);
                TemplateFrame frame;
                frame.y = axis;
                frame.x = std::cos(angle) * side + std::sin(angle) * other;
                frame.z = mirror * frame.x.cross(axis);
                Mat3 axes;
                axes << frame.x, frame.y, frame.z;
                Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
                for (const Vec3& p : surface) {
                    const Vec3 q = axes.transpose() * p;
                    low = low.cwiseMin(q);
                    high = high.cwiseMax(q);
                }
                double sum = 0;
                for (std::size_t end = 0; end < 2; ++end)
                    for (const Vec3& p : ends[end])
                        sum += nearest_distance(axes * (low + p.cwiseProduct(high - low)), some[end]);
                if (sum < best * (1.0 - 1e-9)) {
                    best = sum;
                    best_frame = frame;
                }
            }
    return best_frame;
}

} // namespace fascicle
