#include "solver/xpbd/xpbd_solver.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/bytes_of.hpp"
#include "fascicle/base/parallel.hpp"
#include "solver/coarse/coarse_correction.hpp"
#include "solver/constraints/dihedral.hpp"
#include "solver/constraints/distance.hpp"
#include "solver/constraints/volume.hpp"
#include "solver/contact/contact_setup.hpp"
#include "solver/contact/grid_slope.hpp"
#include "solver/contact/plane_contact.hpp"
#include "solver/contact/sample_guard.hpp"
#include "solver/fast/fast_solver.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace fascicle::solver {

namespace {

using Clock = std::chrono::steady_clock;

class XpbdSolver final : public SoftBodySolver {
public:
    explicit XpbdSolver(const SoftBodyProblem& problem);
    void advance(std::span<const Pose> from, std::span<const Pose> to) override;
    const Points& positions() const override { return x_; }
    bool takes_planes() const override { return true; }
    void set_planes(std::span<const PointPlane> planes) override {
        planes_.assign(planes.begin(), planes.end());
    }
    const StepReport& report() const override { return report_; }
    const std::vector<int>& body_of_vertex() const override { return problem_.body_of_vertex; }
    Points last_step() const override;
    bool set_state(const Points& positions, const Points& last_step) override;
    void set_active_length(double share) override {
        if (!problem_.edge_along.empty())
            edges_.set_active_length(share);
    }
    std::size_t state_bytes() const override;

private:
    void substep(std::span<const Pose> from, std::span<const Pose> to, int k);
    void predict(double h);
    void resolve_contacts(int substep);
    void guard_samples(bool last);
    void update_velocities(double h);

    SoftBodyProblem problem_;
    MeshTopology topology_;
    DistanceConstraints edges_;
    DihedralConstraints dihedrals_;
    VolumeConstraint volume_;
    ContactSettings contact_;
    int substeps_;
    double frame_time_;
    double damping_;
    Points x_, before_, velocity_;
    Points carried_; ///< by how much the solids' motion took each point along in this substep; no part of its
                     ///< velocity
    std::vector<double> inverse_mass_;
    class GuardedVertices;
    std::vector<ContactSolid> solids_, frame_solids_; ///< during the substep, during the frame
    Points frame_start_;
    std::vector<PointPlane> planes_; ///< of this frame
    std::vector<ContactSample> samples_;
    std::vector<std::uint8_t> near_; ///< by sample: substeps to look at it in; found to be too near
    std::vector<std::uint8_t> found_;
    SampleGuard guard_;
    GuardCounts vertex_counts_, sample_counts_;
    std::vector<ContactResult> touched_;
    Points contact_normals_;  ///< of the last substep's contacts, zero where there was none
    CoarseCorrection coarse_; ///< empty when solver.coarse is 0
    ElasticTerms terms_;
    double balance_ = 1.0; ///< kappa of the sweeps: 1 without a coarse correction
    StepReport report_;
};

DistanceConstraints make_edges(const SoftBodyProblem& problem, const MeshTopology& topology) {
    DistanceConstraints constraints;
    for (const DistanceConstraint& edge :
         make_edge_constraints(problem, problem.surface->positions, topology))
        constraints.add(edge);
    return constraints;
}

XpbdSolver::XpbdSolver(const SoftBodyProblem& problem)
    : problem_(problem), topology_(problem.surface->vertex_count(), problem.surface->triangles),
      edges_(make_edges(problem, topology_)),
      dihedrals_(problem.surface->positions, topology_.dihedrals(), problem.parameters.get("solver.bending")),
      volume_(problem.surface->positions, problem.surface->triangles,
              problem.parameters.get("solver.pressure"),
              problem.parameters.get_choice("solver.volume") == "kept"),
      substeps_(passes_per_frame(problem.parameters)),
      frame_time_(problem.parameters.get("solver.frame_time")),
      damping_(problem.parameters.get("solver.damping")), x_(problem.surface->positions), before_(x_),
      velocity_(x_.size(), Vec3::Zero()), carried_(x_.size(), Vec3::Zero()),
      inverse_mass_(inverse_masses(problem, topology_)), touched_(x_.size()) {
    FASCICLE_ASSERT(problem_.body_of_vertex.size() == x_.size());
    contact_ = contact_settings(problem);
    const int clusters = coarse_clusters(problem, inverse_mass_);
    if (clusters > 0)
        coarse_ =
            CoarseCorrection(x_, topology_, inverse_mass_, clusters, passes_per_frame(problem.parameters));
    if (!coarse_.empty()) {
        const double h = frame_time_ / substeps_;
        balance_ = balance_of(edges_.items(), h);
        terms_ = {&edges_.items(), &dihedrals_.items(), problem.parameters.get("solver.bending"), h,
                  1.0 - 1.0 / balance_};
    }
    for (const SolidBody& solid : problem_.solids) {
        FASCICLE_ASSERT(solid.grid != nullptr);
        solids_.push_back({solid.grid.get(), Pose{}, Pose{}, largest_slope(*solid.grid, problem.threads)});
    }
    frame_solids_ = solids_;
    if (!solids_.empty())
        samples_ = contact_samples_of(problem_, topology_);
    near_.assign(samples_.size(), 0);
    found_ = near_;
    guard_ = SampleGuard(x_.size());
}

void XpbdSolver::advance(std::span<const Pose> from, std::span<const Pose> to) {
    FASCICLE_ASSERT(from.size() == solids_.size() && to.size() == solids_.size());
    frame_start_ = x_;
    for (std::size_t b = 0; b < solids_.size(); ++b) {
        frame_solids_[b].before = from[b];
        frame_solids_[b].now = to[b];
    }
    for (int k = 0; k < substeps_; ++k)
        substep(from, to, k);
    set_guard_counts(report_, vertex_counts_, sample_counts_);
    planes_.clear();
}

std::size_t XpbdSolver::state_bytes() const {
    return bytes_of(problem_.body_of_vertex, problem_.edge_softness, problem_.carry_weights, x_, before_,
                    velocity_, carried_, inverse_mass_, touched_, contact_normals_, frame_start_, samples_,
                    near_, found_) +
           topology_.bytes() + edges_.bytes() + dihedrals_.bytes() + volume_.bytes() + coarse_.bytes() +
           guard_.bytes();
}

void XpbdSolver::substep(std::span<const Pose> from, std::span<const Pose> to, int k) {
    const double s0 = double(k) / substeps_, s1 = double(k + 1) / substeps_;
    const double h = frame_time_ / substeps_;
    for (std::size_t b = 0; b < solids_.size(); ++b) {
        solids_[b].before = screw_between(from[b], to[b], s0);
        solids_[b].now = screw_between(from[b], to[b], s1);
    }
    const auto start = Clock::now();
    auto lap = start;
    const auto stage = [&](const char* name) {
        const auto now = Clock::now();
        report_.stage_seconds[name] += std::chrono::duration<double>(now - lap).count();
        lap = now;
    };
    predict(h);
    stage("predict");
    if (!coarse_.empty()) {
        coarse_.correct(x_, terms_, volume_, inverse_mass_, contact_normals_);
        stage("coarse");
    }
    edges_.project(x_, inverse_mass_, h, balance_);
    stage("edges");
    dihedrals_.project(x_, inverse_mass_, h, balance_);
    stage("dihedrals");
    volume_.project(x_, inverse_mass_, contact_normals_);
    stage("volume");
    resolve_contacts(k); // last, so that no other constraint pushes a vertex back in
    stage("contact");
    guard_samples(k + 1 == substeps_);
    stage("samples");
    update_velocities(h);
    stage("velocity");
}

void XpbdSolver::predict(double h) {
    before_ = x_;
    const std::size_t solid_count = solids_.size();
    parallel_for(problem_.threads, x_.size(), 2048, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const int body = problem_.body_of_vertex[i];
            if (body >= 0) {
                x_[i] = solids_[static_cast<std::size_t>(body)].now.apply(problem_.surface->positions[i]);
                continue;
            }
            if (inverse_mass_[i] == 0.0)
                continue;
            Vec3 shift = Vec3::Zero();
            if (!problem_.carry_weights.empty())
                for (std::size_t b = 0; b < solid_count; ++b) {
                    const double w = problem_.carry_weights[i * solid_count + b];
                    if (w != 0.0)
                        shift += w * (solids_[b].now.apply(solids_[b].before.apply_inverse(x_[i])) - x_[i]);
                }
            carried_[i] = shift;
            x_[i] += shift + h * velocity_[i];
        }
    });
}

class XpbdSolver::GuardedVertices final : public GuardedPoints {
public:
    explicit GuardedVertices(XpbdSolver& solver) : solver_(solver) {}
    Vec3 now(int point) const override { return solver_.x_[at(point)]; }
    Vec3 before(int point) const override { return solver_.before_[at(point)]; }
    Vec3 at_frame_start(int point) const override { return solver_.frame_start_[at(point)]; }
    bool is_free(int point) const override { return solver_.inverse_mass_[at(point)] != 0.0; }
    Vec3 way(int point) const override {
        return solver_.x_[at(point)] - solver_.before_[at(point)] - solver_.carried_[at(point)];
    }
    void set_way(int point, const Vec3& way) override {
        solver_.carried_[at(point)] = solver_.x_[at(point)] - solver_.before_[at(point)] - way;
    }
    void put(int point, const Vec3& x, const Vec3& normal, bool stopped) override {
        solver_.x_[at(point)] = x;
        if (!normal.isZero(0.0))
            solver_.contact_normals_[at(point)] = normal;
        if (stopped) // its velocity is what is left of the way without what carried it
            solver_.carried_[at(point)] = x - solver_.before_[at(point)];
    }

private:
    static std::size_t at(int point) { return static_cast<std::size_t>(point); }
    XpbdSolver& solver_;
};

void XpbdSolver::resolve_contacts(int substep) {
    if (solids_.empty() && planes_.empty())
        return;
    contact_normals_.resize(x_.size(), Vec3::Zero());
    parallel_for(problem_.threads, x_.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            if (inverse_mass_[i] != 0.0) {
                touched_[i] = resolve_contact(x_[i], before_[i], solids_, contact_);
                contact_normals_[i] = touched_[i].normal;
            }
    });
    GuardedVertices points(*this);
    for (std::size_t i = 0; i < x_.size(); ++i)
        if (inverse_mass_[i] != 0.0 && x_[i].allFinite())
            guard_point(points, static_cast<int>(i), solids_, false, contact_, vertex_counts_);
    for (const PointPlane& plane : planes_)
        report_.contacts +=
            hold_to_plane(plane, plane.vertex, substep, substeps_, points, solids_, contact_, vertex_counts_)
                ? 1
                : 0;
    for (const ContactResult& result : touched_) {
        report_.contacts += result.touched ? 1 : 0;
        report_.unresolved += result.outside ? 0 : 1;
    }
}

/// Rounds of looking at samples and moving the corners of those that are too near to a solid: in the last substep of a frame at all
/// of them until none is, before once at those that were a short while ago.
void XpbdSolver::guard_samples(bool last) {
    GuardedVertices points(*this);
    const int rounds = last ? SampleGuard::most_rounds : 1;
    for (int round = 0; round < rounds; ++round) {
        parallel_for(problem_.threads, samples_.size(), 1024, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                found_[i] = (last || near_[i] > 0) &&
                            find_violation(samples_[i], samples_[i].at(x_), solids_, contact_).solid >= 0;
        });
        if (round == 0)
            guard_.begin(frame_solids_);
        bool moved = false;
        for (std::size_t i = 0; i < samples_.size(); ++i) {
            if (round == 0 && near_[i] > 0)
                --near_[i];
            if (found_[i] == 0)
                continue;
            near_[i] = SampleGuard::hot_substeps;
            moved |= guard_.resolve(samples_[i], round, points, solids_, contact_, sample_counts_);
        }
        if (!moved &&
            (round >= SampleGuard::push_rounds || std::find(found_.begin(), found_.end(), 1) == found_.end()))
            return;
    }
}

Points XpbdSolver::last_step() const {
    const double h = frame_time_ / substeps_;
    Points step = velocity_;
    for (Vec3& s : step)
        s *= h / std::exp(-damping_ * h);
    return step;
}

bool XpbdSolver::set_state(const Points& positions, const Points& last_step) {
    FASCICLE_ASSERT(positions.size() == x_.size() && last_step.size() == x_.size());
    const double h = frame_time_ / substeps_;
    x_ = before_ = positions;
    for (std::size_t i = 0; i < x_.size(); ++i)
        velocity_[i] = std::exp(-damping_ * h) / h * last_step[i];
    return true;
}

void XpbdSolver::update_velocities(double h) {
    const double keep = std::exp(-damping_ * h);
    for (std::size_t i = 0; i < x_.size(); ++i) {
        if (inverse_mass_[i] == 0.0)
            continue;
        if (!x_[i].allFinite()) { // refused where it is born: the point stays where it was
            x_[i] = before_[i];
            velocity_[i].setZero();
            ++report_.non_finite;
            continue;
        }
        velocity_[i] = keep / h * (x_[i] - before_[i] - carried_[i]);
    }
}

} // namespace

std::unique_ptr<SoftBodySolver> make_xpbd_solver(const SoftBodyProblem& problem) {
    if (problem.parameters.get_choice("solver.kernel") == "fast")
        if (auto fast = make_fast_solver(problem))
            return fast;
    return std::make_unique<XpbdSolver>(problem);
}

} // namespace fascicle::solver
