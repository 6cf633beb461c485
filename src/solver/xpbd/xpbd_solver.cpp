#include "solver/xpbd/xpbd_solver.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/bytes_of.hpp"
#include "fascicle/base/parallel.hpp"
#include "solver/coarse/coarse_correction.hpp"
#include "solver/constraints/dihedral.hpp"
#include "solver/constraints/distance.hpp"
#include "solver/constraints/volume.hpp"
#include "solver/contact/solid_contact.hpp"
#include "solver/edge_constraints.hpp"
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
    const StepReport& report() const override { return report_; }
    const std::vector<int>& body_of_vertex() const override { return problem_.body_of_vertex; }
    std::size_t state_bytes() const override;

private:
    void substep(std::span<const Pose> from, std::span<const Pose> to, double s0, double s1);
    void predict(double h);
    void resolve_contacts();
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
    std::vector<ContactSolid> solids_;
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
              problem.parameters.get("solver.pressure")),
      substeps_(passes_per_frame(problem.parameters)),
      frame_time_(problem.parameters.get("solver.frame_time")),
      damping_(problem.parameters.get("solver.damping")), x_(problem.surface->positions), before_(x_),
      velocity_(x_.size(), Vec3::Zero()), carried_(x_.size(), Vec3::Zero()),
      inverse_mass_(inverse_masses(problem, topology_)), touched_(x_.size()) {
    FASCICLE_ASSERT(problem_.body_of_vertex.size() == x_.size());
    contact_.offset = problem.parameters.get("contact.offset_mm") / problem.unit_mm;
    contact_.friction = problem.parameters.get("contact.friction");
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
        solids_.push_back({solid.grid.get(), Pose{}, Pose{}});
    }
}

void XpbdSolver::advance(std::span<const Pose> from, std::span<const Pose> to) {
    FASCICLE_ASSERT(from.size() == solids_.size() && to.size() == solids_.size());
    for (int k = 0; k < substeps_; ++k)
        substep(from, to, double(k) / substeps_, double(k + 1) / substeps_);
}

std::size_t XpbdSolver::state_bytes() const {
    return bytes_of(problem_.body_of_vertex, problem_.edge_softness, problem_.carry_weights, x_, before_,
                    velocity_, carried_, inverse_mass_, touched_, contact_normals_) +
           topology_.bytes() + edges_.bytes() + dihedrals_.bytes() + volume_.bytes() + coarse_.bytes();
}

void XpbdSolver::substep(std::span<const Pose> from, std::span<const Pose> to, double s0, double s1) {
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
    resolve_contacts(); // last, so that no other constraint pushes a vertex back in
    stage("contact");
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

void XpbdSolver::resolve_contacts() {
    if (solids_.empty())
        return;
    contact_normals_.resize(x_.size(), Vec3::Zero());
    parallel_for(problem_.threads, x_.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            if (inverse_mass_[i] != 0.0) {
                touched_[i] = resolve_contact(x_[i], before_[i], solids_, contact_);
                contact_normals_[i] = touched_[i].normal;
            }
    });
    for (const ContactResult& result : touched_) {
        report_.contacts += result.touched ? 1 : 0;
        report_.unresolved += result.outside ? 0 : 1;
    }
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
