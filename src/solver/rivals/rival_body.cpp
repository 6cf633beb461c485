#include "solver/rivals/rival_body.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/bytes_of.hpp"
#include "fascicle/base/parallel.hpp"
#include "solver/contact/contact_setup.hpp"
#include "solver/contact/grid_slope.hpp"
#include "solver/contact/plane_contact.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace fascicle::solver {

/// Positions alone: a rival with velocities takes them from where contact left its points.
class RivalBody::Guarded final : public GuardedPoints {
public:
    explicit Guarded(RivalBody& body) : body_(body) {}
    Vec3 now(int point) const override { return body_.x_[at(point)]; }
    Vec3 before(int point) const override { return body_.before_[at(point)]; }
    Vec3 at_frame_start(int point) const override { return body_.frame_start_[at(point)]; }
    bool is_free(int point) const override { return body_.is_free(at(point)); }
    Vec3 way(int) const override { return Vec3::Zero(); }
    void set_way(int, const Vec3&) override {}
    void put(int point, const Vec3& x, const Vec3& normal, bool) override {
        body_.x_[at(point)] = x;
        if (!normal.isZero(0.0))
            body_.normals_[at(point)] = normal;
    }

private:
    static std::size_t at(int point) { return static_cast<std::size_t>(point); }
    RivalBody& body_;
};

RivalBody::RivalBody(const SoftBodyProblem& problem)
    : problem_(problem), topology_(problem.surface->vertex_count(), problem.surface->triangles),
      inverse_mass_(inverse_masses(problem, topology_)),
      volume_(problem.surface->positions, problem.surface->triangles,
              problem.parameters.get("solver.pressure"),
              problem.parameters.get_choice("solver.volume") == "kept"),
      contact_(contact_settings(problem)), passes_(passes_per_frame(problem.parameters)),
      x_(problem.surface->positions), before_(x_), frame_start_(x_), normals_(x_.size(), Vec3::Zero()),
      touched_(x_.size()), guard_(x_.size()) {
    FASCICLE_ASSERT(problem_.body_of_vertex.size() == x_.size());
    for (const SolidBody& solid : problem_.solids) {
        FASCICLE_ASSERT(solid.grid != nullptr);
        solids_.push_back({solid.grid.get(), Pose{}, Pose{}, largest_slope(*solid.grid, problem.threads)});
    }
    frame_solids_ = solids_;
    if (!solids_.empty())
        samples_ = contact_samples_of(problem_, topology_);
    found_.assign(samples_.size(), 0);
}

std::size_t RivalBody::state_bytes() const {
    return bytes_of(problem_.body_of_vertex, problem_.edge_softness, problem_.carry_weights, x_, before_,
                    frame_start_, normals_, inverse_mass_, samples_, found_, touched_) +
           topology_.bytes() + volume_.bytes() + guard_.bytes();
}

void RivalBody::advance(std::span<const Pose> from, std::span<const Pose> to) {
    FASCICLE_ASSERT(from.size() == solids_.size() && to.size() == solids_.size());
    frame_start_ = x_;
    for (std::size_t b = 0; b < solids_.size(); ++b) {
        frame_solids_[b].before = from[b];
        frame_solids_[b].now = to[b];
    }
    for (int k = 0; k < passes_; ++k)
        pass(from, to, k);
    set_guard_counts(report_, vertex_counts_, sample_counts_);
    planes_.clear();
}

void RivalBody::pass(std::span<const Pose> from, std::span<const Pose> to, int k) {
    for (std::size_t b = 0; b < solids_.size(); ++b) {
        solids_[b].before = screw_between(from[b], to[b], double(k) / passes_);
        solids_[b].now = screw_between(from[b], to[b], double(k + 1) / passes_);
    }
    auto lap = std::chrono::steady_clock::now();
    const auto stage = [&](const char* name) {
        const auto now = std::chrono::steady_clock::now();
        report_.stage_seconds[name] += std::chrono::duration<double>(now - lap).count();
        lap = now;
    };
    before_ = x_;
    carry();
    stage("predict");
    deform(param("solver.frame_time") / passes_);
    refuse_non_finite();
    stage("deform");
    keep_volume();
    stage("volume");
    hold_vertices(k);
    stage("contact");
    hold_samples(k + 1 == passes_);
    stage("samples");
    contacted();
}

void RivalBody::carry() {
    for (std::size_t i = 0; i < x_.size(); ++i) {
        const int body = problem_.body_of_vertex[i];
        if (body >= 0) {
            x_[i] = solids_[static_cast<std::size_t>(body)].now.apply(rest()[i]);
            continue;
        }
        if (!is_free(i) || problem_.carry_weights.empty())
            continue;
        Vec3 shift = Vec3::Zero();
        for (std::size_t b = 0; b < solids_.size(); ++b) {
            const double w = problem_.carry_weights[i * solids_.size() + b];
            if (w != 0.0)
                shift += w * (solids_[b].now.apply(solids_[b].before.apply_inverse(x_[i])) - x_[i]);
        }
        x_[i] += shift;
    }
}

void RivalBody::refuse_non_finite() {
    for (std::size_t i = 0; i < x_.size(); ++i)
        if (is_free(i) && !x_[i].allFinite()) {
            x_[i] = before_[i];
            ++report_.non_finite;
        }
}

/// A few Newton steps: a method without a volume term of its own may be far off after one pass.
void RivalBody::keep_volume() {
    constexpr int most_steps = 4;
    constexpr double enough = 1e-6;
    for (int step = 0; step < most_steps && volume_.kept(); ++step) {
        const double off = volume_.evaluate(x_) - volume_.wanted_volume();
        if (std::abs(off) <= enough * std::abs(volume_.rest_volume()))
            return;
        volume_.project(x_, inverse_mass_, normals_);
    }
}

void RivalBody::hold_vertices(int k) {
    std::fill(normals_.begin(), normals_.end(), Vec3::Zero());
    if (solids_.empty() && planes_.empty())
        return;
    std::fill(touched_.begin(), touched_.end(), ContactResult{});
    parallel_for(problem_.threads, x_.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            if (is_free(i)) {
                touched_[i] = resolve_contact(x_[i], before_[i], solids_, contact_);
                normals_[i] = touched_[i].normal;
            }
    });
    Guarded points(*this);
    for (std::size_t i = 0; i < x_.size(); ++i)
        if (is_free(i) && x_[i].allFinite())
            guard_point(points, static_cast<int>(i), solids_, false, contact_, vertex_counts_);
    for (const PointPlane& plane : planes_)
        report_.contacts +=
            hold_to_plane(plane, plane.vertex, k, passes_, points, solids_, contact_, vertex_counts_) ? 1 : 0;
    for (const ContactResult& result : touched_) {
        report_.contacts += result.touched ? 1 : 0;
        report_.unresolved += result.outside ? 0 : 1;
    }
}

/// As xpbd does: once in a pass, until none is too near in the last pass of a frame.
void RivalBody::hold_samples(bool last) {
    Guarded points(*this);
    const int rounds = last ? SampleGuard::most_rounds : 1;
    for (int round = 0; round < rounds && !samples_.empty(); ++round) {
        parallel_for(problem_.threads, samples_.size(), 1024, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                found_[i] = find_violation(samples_[i], samples_[i].at(x_), solids_, contact_).solid >= 0;
        });
        if (round == 0)
            guard_.begin(frame_solids_);
        bool moved = false;
        for (std::size_t i = 0; i < samples_.size(); ++i)
            if (found_[i] != 0)
                moved |= guard_.resolve(samples_[i], round, points, solids_, contact_, sample_counts_);
        if (!moved &&
            (round >= SampleGuard::push_rounds || std::find(found_.begin(), found_.end(), 1) == found_.end()))
            return;
    }
}

} // namespace fascicle::solver
