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
    Points last_step() const override;
    bool set_state(const Points& positions, const Points& last_step) override;
    void set_active_length(double share) override;
    std::size_t state_bytes() const override;

private:
    void make_records();
    void make_groups();
    void make_fixed_groups();
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
    void collect(const GroupRange& range, std::span<const Pose> to);
    void sum_reports();
    VertexArrays arrays();

    SoftBodyProblem problem_;
    Plan plan_;
    const Kernels& kernels_;
    FastCoarse coarse_;
    int substeps_;
    double wanted_volume_ = 0, largest_volume_step_ = 0;
    StepSettings settings_{};

    std::vector<Row> records_; ///< four rows of 16 floats per group: 16 records
    std::vector<VertexGroup> groups_;
    std::vector<Row> slack_, carry_;
    std::vector<FixedGroup> fixed_;
    std::vector<std::size_t> first_fixed_; ///< by chunk, and one more
    std::vector<VolumeSums> volume_sums_;
    std::vector<ContactSums> contact_sums_;
    std::vector<int> vertex_of_record_; ///< -1 for padding
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
      substeps_(passes_per_frame(problem.parameters)),
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
    largest_volume_step_ = VolumeConstraint::max_step * std::abs(rest_volume);
    volume_sums_.resize(plan_.chunks.size());
    contact_sums_.resize(plan_.chunks.size());
    make_records();
    make_groups();
    make_fixed_groups();
    // Only the arrays made of them are needed from here on.
    plan_.rest = {};
    problem_.edge_softness = {};
    problem_.edge_along = {};
    problem_.carry_weights = {};
}

void FastSolver::make_records() {
    records_.resize(4 * plan_.groups);
    auto* records = reinterpret_cast<float*>(records_.data());
    // Padding gets the corners of a hinge without slivers; nothing ever moves it.
    constexpr float corners[4][3] = {{0.5f, 1, 0}, {0.5f, -1, 0}, {0, 0, 0}, {1, 0, 0}};
    for (std::size_t r = 0; r < plan_.records(); ++r)
        for (std::size_t k = 0; k < 3; ++k)
            records[4 * r + k] = corners[r % 4][k];
    vertex_of_record_.assign(plan_.records(), -1);
    for (std::size_t i = 0; i < plan_.rest.size(); ++i) {
        const auto r = static_cast<std::size_t>(plan_.record_of_vertex[i]);
        vertex_of_record_[r] = static_cast<int>(i);
        for (std::size_t k = 0; k < 3; ++k)
            records[4 * r + k] = static_cast<float>(plan_.rest[i][static_cast<Eigen::Index>(k)]);
        records[4 * r + 3] = plan_.inverse_mass[r];
    }
}

void FastSolver::make_groups() {
    groups_.resize(plan_.groups);
    const auto* records = reinterpret_cast<const float*>(records_.data());
    for (std::size_t g = 0; g < plan_.groups; ++g) {
        VertexGroup& group = groups_[g];
        group = VertexGroup{};
        group.ring_base = plan_.ring_base[g];
        group.ring_first = plan_.ring_first[g];
        group.ring_length = plan_.ring_length[g];
        for (std::size_t i = 0; i < packet; ++i)
            for (std::size_t k = 0; k < 3; ++k)
                group.start[k][i] = group.carried[k][i] = records[4 * (packet * g + i) + k];
    }
    const std::size_t solids = problem_.solids.size();
    slack_.assign(plan_.groups * solids, Row{});
    if (problem_.carry_weights.empty())
        return;
    carry_.assign(plan_.groups * solids, Row{});
    for (std::size_t i = 0; i < plan_.rest.size(); ++i) {
        const auto r = static_cast<std::size_t>(plan_.record_of_vertex[i]);
        for (std::size_t b = 0; b < solids; ++b)
            carry_[r / packet * solids + b].v[r % packet] =
                static_cast<float>(problem_.carry_weights[i * solids + b]);
    }
}

void FastSolver::make_fixed_groups() {
    std::vector<std::array<std::size_t, 3>> fixed; // group, solid, vertex
    for (std::size_t i = 0; i < plan_.rest.size(); ++i)
        if (problem_.body_of_vertex[i] >= 0)
            fixed.push_back({static_cast<std::size_t>(plan_.record_of_vertex[i]) / packet,
                             static_cast<std::size_t>(problem_.body_of_vertex[i]), i});
    std::sort(fixed.begin(), fixed.end());
    for (const auto& [group, solid, vertex] : fixed) {
        if (fixed_.empty() || fixed_.back().group != group || fixed_.back().solid != solid) {
            FixedGroup next{};
            next.group = static_cast<std::uint32_t>(group);
            next.solid = static_cast<std::uint32_t>(solid);
            fixed_.push_back(next);
        }
        const auto lane = static_cast<std::size_t>(plan_.record_of_vertex[vertex]) % packet;
        fixed_.back().mask |= 1u << lane;
        for (std::size_t k = 0; k < 3; ++k)
            fixed_.back().rest[k][lane] =
                static_cast<float>(plan_.rest[vertex][static_cast<Eigen::Index>(k)]);
    }
    std::size_t next = 0;
    for (const GroupRange& chunk : plan_.chunks) {
        first_fixed_.push_back(next);
        while (next < fixed_.size() && fixed_[next].group < chunk.end)
            ++next;
    }
    first_fixed_.push_back(next);
}

VertexArrays FastSolver::arrays() {
    return {reinterpret_cast<float*>(records_.data()), groups_.data(),
            reinterpret_cast<float*>(slack_.data()),
            carry_.empty() ? nullptr : reinterpret_cast<const float*>(carry_.data()), plan_.rings.data()};
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
    float* base = reinterpret_cast<float*>(records_.data()) + 4 * set.first_record;
    kernels_.edges(base, plan_.edges.data() + set.first_edge, set.edges);
    kernels_.hinges(base, plan_.hinges.data() + set.first_hinge, set.hinges, plan_.relax);
}

void FastSolver::place(std::size_t chunk, const SolidStep* solids) {
    kernels_.place(arrays(), fixed_.data() + first_fixed_[chunk],
                   first_fixed_[chunk + 1] - first_fixed_[chunk], solids);
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
    const auto* records = reinterpret_cast<const float*>(records_.data());
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
        coarse_.solve(total_volume().volume - wanted_volume_, with_frames);
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
                collect(range, to);
        });
        if (k + 1 < substeps_)
            meet();
        stage(predict_stage);
    }
}

std::size_t FastSolver::state_bytes() const {
    return bytes_of(records_, groups_, slack_, carry_, fixed_, positions_, plan_.edges, plan_.active,
                    plan_.hinges, plan_.rings, plan_.record_of_vertex, vertex_of_record_, plan_.inverse_mass,
                    plan_.ring_base, plan_.ring_first, plan_.ring_length, problem_.body_of_vertex) +
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

Points FastSolver::last_step() const {
    Points step(positions_.size(), Vec3::Zero());
    const auto* records = reinterpret_cast<const float*>(records_.data());
    for (std::size_t r = 0; r < vertex_of_record_.size(); ++r)
        for (std::size_t k = 0; vertex_of_record_[r] >= 0 && k < 3; ++k)
            step[static_cast<std::size_t>(vertex_of_record_[r])][static_cast<Eigen::Index>(k)] =
                double(records[4 * r + k]) - double(groups_[r / packet].carried[k][r % packet]);
    return step;
}

bool FastSolver::set_state(const Points& positions, const Points& last_step) {
    FASCICLE_ASSERT(!started_ && positions.size() == positions_.size() &&
                    last_step.size() == positions.size());
    positions_ = positions;
    auto* records = reinterpret_cast<float*>(records_.data());
    for (std::size_t r = 0; r < vertex_of_record_.size(); ++r) {
        if (vertex_of_record_[r] < 0)
            continue;
        const auto i = static_cast<std::size_t>(vertex_of_record_[r]);
        const Vec3 x = positions[i] - plan_.origin;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto axis = static_cast<Eigen::Index>(k);
            records[4 * r + k] = static_cast<float>(x[axis]);
            groups_[r / packet].start[k][r % packet] = static_cast<float>(x[axis]);
            groups_[r / packet].carried[k][r % packet] = static_cast<float>(x[axis] - last_step[i][axis]);
        }
    }
    return true;
}

/// Positions in the caller's order and frame.
void FastSolver::collect(const GroupRange& range, std::span<const Pose> to) {
    const auto* records = reinterpret_cast<const float*>(records_.data());
    for (std::size_t r = packet * range.begin; r < packet * range.end; ++r) {
        const int vertex = vertex_of_record_[r];
        if (vertex < 0)
            continue;
        const auto i = static_cast<std::size_t>(vertex);
        const int body = problem_.body_of_vertex[i];
        const float* p = records + 4 * r;
        positions_[i] = body >= 0 ? to[static_cast<std::size_t>(body)].apply(problem_.surface->positions[i])
                                  : Vec3(plan_.origin + Vec3(double(p[0]), double(p[1]), double(p[2])));
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
