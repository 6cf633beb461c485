#include "solver/fast/fast_solver.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/bytes_of.hpp"
#include "fascicle/base/parallel.hpp"
#include "fascicle/geometry/volume.hpp"
#include "solver/coarse/elastic_terms.hpp"
#include "solver/constraints/volume.hpp"
#include "solver/contact/contact_setup.hpp"
#include "solver/fast/chunk_split.hpp"
#include "solver/fast/fast_coarse.hpp"
#include "solver/fast/fast_contact.hpp"
#include "solver/fast/fast_vertices.hpp"
#include "solver/fast/plan.hpp"
#include "solver/fast/thread_choice.hpp"
#include "solver/fast/worker_team.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace fascicle::solver {

namespace fast {

namespace {

using Clock = std::chrono::steady_clock;

/// Stages as the report names them, timed by the first thread.
enum Stage : std::size_t {
    predict_stage,
    coarse_stage,
    constraint_stage,
    volume_stage,
    contact_stage,
    sample_stage,
    stage_count
};
constexpr std::array<const char*, stage_count> stage_names{"predict", "coarse",  "edges and dihedrals",
                                                           "volume",  "contact", "samples"};

class FastSolver final : public SoftBodySolver {
public:
    FastSolver(const SoftBodyProblem& problem, const MeshTopology& topology, Plan plan, CoarseMatrix coarse,
               const Kernels& kernels);
    void advance(std::span<const Pose> from, std::span<const Pose> to) override;
    const Points& positions() const override { return positions_; }
    const StepReport& report() const override { return report_; }
    const std::vector<int>& body_of_vertex() const override { return problem_.body_of_vertex; }
    bool uses_threads() const override { return true; }
    bool takes_planes() const override { return true; }
    void set_planes(std::span<const PointPlane> planes) override { contact_.set_planes(planes); }
    Points last_step() const override { return vertices_.last_step(positions_.size()); }
    bool set_state(const Points& positions, const Points& last_step) override {
        FASCICLE_ASSERT(!started_ && positions.size() == positions_.size() &&
                        last_step.size() == positions.size());
        positions_ = positions;
        vertices_.set_state(positions, last_step, plan_.origin);
        return true;
    }
    void set_active_length(double share) override;
    std::size_t state_bytes() const override;

private:
    void run_frame(int thread, int threads, std::span<const Pose> to);
    void sweep(const ConstraintSet& set);
    template <typename Meet>
    void guard_samples(int thread, int threads, int substep, const Meet& meet);
    template <typename Chunks, typename Meet>
    void correct(int thread, int threads, bool with_frames, const Chunks& for_chunks, const Meet& meet);
    VolumeSums total_volume() const;
    void sum_volume(std::size_t chunk);
    StepSettings settings_after_volume() const;
    void place(std::size_t chunk, const SolidStep* solids);
    void sum_reports();
    VertexArrays arrays() { return vertices_.arrays(plan_.rings.data()); }

    SoftBodyProblem problem_;
    Plan plan_;
    const Kernels& kernels_;
    FastCoarse coarse_;
    int substeps_;
    double wanted_volume_ = 0, largest_volume_step_ = 0;
    bool keeps_volume_ = true;
    StepSettings settings_{};

    FastVertices vertices_;
    std::vector<VolumeSums> volume_sums_;
    std::vector<ContactSums> contact_sums_;
    WorkerTeam team_;
    FastContact contact_;
    bool started_ = false;
    GuardCounts vertex_counts_;
    ThreadChoice choice_;
    ChunkSplit split_;
    Points positions_;
    StepReport report_;
    std::array<double, stage_count> stage_seconds_{};
};

FastSolver::FastSolver(const SoftBodyProblem& problem, const MeshTopology& topology, Plan plan,
                       CoarseMatrix coarse, const Kernels& kernels)
    : problem_(problem), plan_(std::move(plan)), kernels_(kernels),
      coarse_(problem, topology, std::move(coarse), plan_, kernels),
      substeps_(passes_per_frame(problem.parameters)), vertices_(problem, plan_),
      team_(std::clamp(problem.threads, 1, static_cast<int>(plan_.interiors.size()))),
      contact_(problem, topology, plan_, kernels, team_.size()), split_(plan_.chunks.size(), team_.size()),
      positions_(problem.surface->positions) {
    const ParamSet& p = problem_.parameters;
    const ContactSettings contact = contact_settings(problem);
    settings_.offset = static_cast<float>(contact.offset);
    settings_.least = static_cast<float>(contact.least);
    settings_.friction = static_cast<float>(contact.friction);
    settings_.keep =
        static_cast<float>(std::exp(-p.get("solver.damping") * p.get("solver.frame_time") / substeps_));
    settings_.solids = static_cast<int>(problem_.solids.size());
    const double rest_volume = signed_volume(plan_.rest, problem_.surface->triangles);
    wanted_volume_ = p.get("solver.pressure") * rest_volume;
    keeps_volume_ = p.get_choice("solver.volume") == "kept";
    largest_volume_step_ = VolumeConstraint::max_step * std::abs(rest_volume);
    volume_sums_.resize(plan_.chunks.size());
    contact_sums_.resize(plan_.chunks.size());
    // Only the arrays made of them are needed from here on.
    plan_.rest = {};
    problem_.edge_softness = {};
    problem_.edge_along = {};
    problem_.carry_weights = {};
}

void FastSolver::advance(std::span<const Pose> from, std::span<const Pose> to) {
    FASCICLE_ASSERT(from.size() == problem_.solids.size() && to.size() == problem_.solids.size());
    contact_.set_solids(from, to);
    if (!started_)
        contact_.set_slack(arrays());
    started_ = true;
    std::fill(contact_sums_.begin(), contact_sums_.end(), ContactSums{});
    const auto start = Clock::now();
    if (team_.size() == 1 || choice_.alone()) {
        run_frame(0, 1, to);
    } else {
        auto body = [&](int thread) { run_frame(thread, team_.size(), to); };
        team_.run(body);
        split_.balance();
    }
    if (team_.size() > 1)
        choice_.record(std::chrono::duration<double>(Clock::now() - start).count());
    sum_reports();
    contact_.set_planes({});
}

void FastSolver::sweep(const ConstraintSet& set) {
    float* base = vertices_.records() + 4 * set.first_record;
    kernels_.edges(base, plan_.edges.data() + set.first_edge, set.edges);
    kernels_.hinges(base, plan_.hinges.data() + set.first_hinge, set.hinges, plan_.relax);
}

void FastSolver::place(std::size_t chunk, const SolidStep* solids) {
    const std::span<const FixedGroup> fixed = vertices_.fixed(chunk);
    kernels_.place(arrays(), fixed.data(), fixed.size(), solids);
}

void FastSolver::sum_volume(std::size_t chunk) {
    const GroupRange range = plan_.chunks[chunk];
    kernels_.volume(arrays(), range.begin, range.end, volume_sums_[chunk]);
}

VolumeSums FastSolver::total_volume() const {
    VolumeSums total;
    for (const VolumeSums& part : volume_sums_) {
        total.volume += part.volume;
        total.weight_grow += part.weight_grow;
        total.weight_shrink += part.weight_shrink;
    }
    return total;
}

StepSettings FastSolver::settings_after_volume() const {
    if (!keeps_volume_)
        return settings_; // error and gain 0
    const VolumeSums total = total_volume();
    const double error =
        std::clamp(total.volume - wanted_volume_, -largest_volume_step_, largest_volume_step_);
    const double weight = error < 0.0 ? total.weight_grow : total.weight_shrink;
    StepSettings settings = settings_;
    settings.volume_error = static_cast<float>(error);
    settings.volume_gain = weight > 0.0 ? static_cast<float>(-error / weight) : 0.0f;
    return settings;
}

/// The coarse step, from the predicted positions; each part waits for all of the one before.
template <typename Chunks, typename Meet>
void FastSolver::correct(int thread, int threads, bool with_frames, const Chunks& for_chunks,
                         const Meet& meet) {
    const auto share = [&](std::size_t count, int t) {
        return count * static_cast<std::size_t>(t) / static_cast<std::size_t>(threads);
    };
    const auto each = [&](std::size_t count, const auto& body) {
        for (std::size_t i = share(count, thread); i < share(count, thread + 1); ++i)
            body(i);
    };
    const float* records = vertices_.records();
    const std::size_t interiors = plan_.interiors.size(), interfaces = plan_.interfaces.size();
    each(interiors, [&](std::size_t s) { coarse_.push(records, plan_.interiors[s]); });
    for_chunks([&](std::size_t c, const GroupRange&) { sum_volume(c); });
    meet();
    each(interfaces, [&](std::size_t s) { coarse_.push(records, plan_.interfaces[s]); });
    meet();
    for_chunks([&](std::size_t, const GroupRange& range) { coarse_.load(arrays(), range); });
    meet();
    coarse_.sum(records, thread, threads, with_frames);
    meet();
    if (thread == 0)
        coarse_.prepare(arrays(), with_frames);
    meet();
    if (coarse_.renew()) {
        each(CoarseMatrix::parts, [&](std::size_t p) { coarse_.add_part(p); });
        meet();
    }
    if (thread == 0)
        coarse_.solve(keeps_volume_ ? std::optional(total_volume().volume - wanted_volume_) : std::nullopt,
                      with_frames);
    meet();
    for_chunks([&](std::size_t c, const GroupRange& range) { coarse_.spread(arrays(), range, c); });
    meet();
    each(interiors, [&](std::size_t s) { coarse_.bend(records, plan_.interiors[s], s); });
    each(interfaces, [&](std::size_t s) { coarse_.bend(records, plan_.interfaces[s], interiors + s); });
    meet();
    const double length = coarse_.length();
    for_chunks([&](std::size_t, const GroupRange& range) { coarse_.apply(arrays(), range, length); });
    meet();
    if (thread == 0)
        coarse_.conclude(length);
}

/// Rounds of looking at all samples and moving the corners of those that are too near to a solid.
template <typename Meet>
void FastSolver::guard_samples(int thread, int threads, int substep, const Meet& meet) {
    const int rounds = contact_.is_last(substep) ? SampleGuard::most_rounds : 1;
    bool settled = false;
    for (int round = 0; round < rounds && !settled; ++round) {
        contact_.check_samples(arrays(), thread, threads, substep, settings_);
        meet();
        settled = !contact_.samples_violated();
        if (settled)
            break;
        if (thread == 0)
            contact_.resolve_samples(arrays(), substep, round);
        meet();
        // Within rounding of the limit the lanes see what the closer look does not.
        settled = !contact_.moved_samples() && round >= SampleGuard::push_rounds;
    }
    if (thread == 0 && contact_.is_last(substep))
        contact_.end_frame(settled);
}

void FastSolver::run_frame(int thread, int threads, std::span<const Pose> to) {
    const auto share = [&](std::size_t count, int t) {
        return count * static_cast<std::size_t>(t) / static_cast<std::size_t>(threads);
    };
    const std::size_t first_set = share(plan_.interiors.size(), thread);
    const std::size_t end_set = share(plan_.interiors.size(), thread + 1);
    const std::size_t end_interface = std::min(end_set, plan_.interfaces.size());
    const std::size_t first_chunk = threads > 1 ? split_.begin(thread) : 0;
    const std::size_t end_chunk = threads > 1 ? split_.end(thread) : plan_.chunks.size();
    const auto for_chunks = [&](const auto& body) {
        const auto start = Clock::now();
        for (std::size_t c = first_chunk; c < end_chunk; ++c)
            body(c, plan_.chunks[c]);
        if (threads > 1) // alone it says nothing about the borders
            split_.add(thread, std::chrono::duration<double>(Clock::now() - start).count());
    };
    const auto meet = [&] {
        if (threads > 1)
            team_.meet();
    };
    auto lap = Clock::now();
    const auto stage = [&](Stage s) {
        if (thread != 0)
            return;
        const auto now = Clock::now();
        stage_seconds_[s] += std::chrono::duration<double>(now - lap).count();
        lap = now;
    };
    const auto predict = [&](std::size_t c, const GroupRange& range, int k) {
        kernels_.predict(arrays(), range.begin, range.end, contact_.steps(k), settings_);
        place(c, contact_.steps(k));
        if (!coarse_.empty())
            coarse_.clear(range);
    };

    for_chunks([&](std::size_t c, const GroupRange& range) {
        contact_.begin_frame(arrays(), range);
        predict(c, range, 0);
    });
    meet();
    stage(predict_stage);
    for (int k = 0; k < substeps_; ++k) {
        if (!coarse_.empty()) {
            correct(thread, threads, k == 0, for_chunks, meet);
            stage(coarse_stage);
        }
        for (std::size_t s = first_set; s < end_set; ++s)
            sweep(plan_.interiors[s]);
        meet();
        if (!plan_.interfaces.empty()) {
            for (std::size_t s = first_set; s < end_interface; ++s)
                sweep(plan_.interfaces[s]);
            meet();
        }
        stage(constraint_stage);
        for_chunks([&](std::size_t c, const GroupRange&) { sum_volume(c); });
        meet();
        stage(volume_stage);
        const StepSettings settings = settings_after_volume();
        for_chunks([&](std::size_t c, const GroupRange& range) {
            std::fill_n(contact_.step_travel(c), problem_.solids.size(), 0.0f);
            kernels_.finish(arrays(), range.begin, range.end, contact_.steps(k), settings, contact_sums_[c],
                            contact_.step_travel(c));
            contact_.guard(arrays(), range, k, contact_sums_[c]);
            contact_.hold_planes(arrays(), c, k, contact_sums_[c]);
        });
        meet();
        stage(contact_stage);
        if (contact_.has_samples()) {
            guard_samples(thread, threads, k, meet);
            stage(sample_stage);
        }
        for_chunks([&](std::size_t c, const GroupRange& range) {
            if (k + 1 < substeps_)
                predict(c, range, k + 1);
            else
                vertices_.collect(range, to, problem_, plan_.origin, positions_);
        });
        if (k + 1 < substeps_)
            meet();
        stage(predict_stage);
    }
}

std::size_t FastSolver::state_bytes() const {
    return vertices_.bytes() +
           bytes_of(positions_, plan_.edges, plan_.active, plan_.hinges, plan_.rings, plan_.record_of_vertex,
                    plan_.inverse_mass, plan_.ring_base, plan_.ring_first, plan_.ring_length,
                    problem_.body_of_vertex) +
           coarse_.bytes() + contact_.bytes();
}

void FastSolver::set_active_length(double share) {
    const auto s = static_cast<float>(share);
    const float along = s * s, across = 1.0f / s; // active_edge_scale() in floats
    for (std::size_t e = 0; e < plan_.active.size(); ++e)
        for (std::size_t i = 0; i < packet; ++i) {
            const float c = plan_.active[e].along[i];
            plan_.edges[e].rest[i] = plan_.active[e].rest[i] * std::sqrt(along * c + across * (1.0f - c));
        }
}

void FastSolver::sum_reports() {
    for (const ContactSums& part : contact_sums_) {
        report_.contacts += part.contacts;
        report_.unresolved += part.unresolved;
        report_.non_finite += part.non_finite;
        vertex_counts_.slid += part.slid;
        vertex_counts_.ejected += part.ejected;
        vertex_counts_.impossible += part.impossible;
    }
    set_guard_counts(report_, vertex_counts_, contact_.counts());
    for (std::size_t s = 0; s < stage_count; ++s)
        report_.stage_seconds[stage_names[s]] = stage_seconds_[s];
}

} // namespace

} // namespace fast

std::unique_ptr<SoftBodySolver> make_fast_solver(const SoftBodyProblem& problem,
                                                 const fast::Kernels* kernels) {
    const MeshTopology topology(problem.surface->vertex_count(), problem.surface->triangles);
    const std::vector<double> mass = inverse_masses(problem, topology);
    CoarseMatrix coarse;
    double kappa = 1.0;
    const int clusters = std::min(coarse_clusters(problem, mass), static_cast<int>(fast::max_clusters));
    if (clusters > 0)
        coarse = CoarseMatrix(problem.surface->positions, topology, mass, clusters,
                              passes_per_frame(problem.parameters));
    if (!coarse.empty())
        kappa =
            balance_of(make_edge_constraints(problem, problem.surface->positions, topology),
                       problem.parameters.get("solver.frame_time") / passes_per_frame(problem.parameters));
    auto plan = fast::make_plan(problem, topology, kappa);
    if (!plan)
        return nullptr;
    if (kernels == nullptr)
        fast::available_kernels(&kernels, 1);
    return std::make_unique<fast::FastSolver>(problem, topology, std::move(*plan), std::move(coarse),
                                              *kernels);
}

} // namespace fascicle::solver
