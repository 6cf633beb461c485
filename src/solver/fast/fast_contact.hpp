#pragma once
// Contact of the fast kernel: where the solids are in each substep, and the hard bounds of vertices and samples. Lanes tell which may
// have come too near; those few are dealt with one by one in double, by the code that the plain kernel uses too.

#include "fascicle/solver/soft_body_solver.hpp"
#include "solver/contact/sample_guard.hpp"
#include "solver/fast/plan.hpp"
#include "solver/fast/row.hpp"

namespace fascicle::solver::fast {

class FastContact {
public:
    /// plan and kernels must outlive this.
    FastContact(const SoftBodyProblem& problem, const MeshTopology& topology, const Plan& plan,
                const Kernels& kernels, int threads);
    FastContact(const FastContact&) = delete;
    FastContact& operator=(const FastContact&) = delete;

    /// Before a frame: everything it needs to know of the solids' motion.
    void set_solids(std::span<const Pose> from, std::span<const Pose> to);
    const SolidStep* steps(int substep) const {
        return solid_steps_.data() + static_cast<std::size_t>(substep) * solids_.size();
    }
    /// Before the first frame, solids set: how far vertices may travel.
    void set_slack(const VertexArrays& v);

    /// For every chunk when the frame begins: where its vertices are.
    void begin_frame(const VertexArrays& v, const GroupRange& range);
    /// For every chunk after Kernels::finish, which was given step_travel(chunk): the vertices that it suspects.
    float* step_travel(std::size_t chunk) { return step_travel_.data() + chunk * stride_; }
    void guard(const VertexArrays& v, const GroupRange& range, int substep, ContactSums& sums);
    /// Planes for the next frame, ascending by vertex; none: no planes.
    void set_planes(std::span<const PointPlane> planes);
    /// For every chunk after guard(): the vertices held in half-spaces.
    void hold_planes(const VertexArrays& v, std::size_t chunk, int substep, ContactSums& sums);
    /// By every thread, after all chunks: looks at its share of the samples, in the last substep at all of them that may have come
    /// too near, before at those only that were too near a short while ago. What the frame ends with is what is guaranteed.
    void check_samples(const VertexArrays& v, int thread, int threads, int substep,
                       const StepSettings& settings);
    /// By every thread alike, when all have looked: whether samples are too near.
    bool samples_violated() const;
    /// By one thread then, in round 0, 1, ...: moves their corners. Whether anything was moved.
    void resolve_samples(const VertexArrays& v, int substep, int round);
    /// By one thread, after the last substep's rounds; settled: they ended because nothing was left to do.
    void end_frame(bool settled);
    bool moved_samples() const { return moved_; } ///< by the last of these calls

    bool has_samples() const { return !packets_.empty(); }
    bool is_last(int substep) const { return substep + 1 == substeps_; }
    const GuardCounts& counts() const { return counts_; } ///< of samples, since the start
    std::size_t bytes() const;

private:
    class Records;
    std::size_t chunk_of(std::size_t record) const { return chunk_of_group_[record / packet]; }
    void make_samples(const SoftBodyProblem& problem, const MeshTopology& topology);
    void refresh_slack(const VertexArrays& v, std::size_t record, std::span<const ContactSolid> solids);
    ContactSample sample_of(std::size_t packet_number, std::size_t lane) const;
    std::span<const ContactSolid> solids_at(int substep) const {
        return {contact_solids_.data() + static_cast<std::size_t>(substep) * solids_.size(), solids_.size()};
    }

    const Plan& plan_;
    const Kernels& kernels_;
    std::vector<SolidBody> bodies_;
    int substeps_;
    ContactSettings settings_;
    std::vector<SolidStep> solid_steps_;       ///< substeps x solids
    std::vector<SolidStep> solids_;            ///< what of them does not change
    std::vector<ContactSolid> contact_solids_; ///< substeps x solids, of the same
    std::vector<ContactSolid> frame_solids_;   ///< from the beginning to the end of the frame
    std::vector<float> step_travel_;           ///< chunks x stride: furthest way of a vertex in the substep
    std::vector<float> travel_;                ///< the same, summed up since samples were last looked at
    std::size_t stride_ = 0;                   ///< solids, rounded up to a cache line
    std::vector<std::uint16_t> chunk_of_group_;
    std::vector<SamplePacket> packets_;
    std::vector<float> sample_slack_;       ///< packets x solids
    std::vector<std::uint16_t> violations_; ///< by packet
    std::vector<std::uint8_t> hot_;         ///< by packet: substeps to look at it in, every time
    std::vector<float> frame_start_;        ///< records x 3: where the frame began
    bool moved_ = false;
    std::vector<std::size_t> found_;       ///< by thread, one cache line each: packets with violations
    std::vector<PointPlane> planes_;       ///< of this frame, by record; vertex: the record
    std::vector<std::size_t> first_plane_; ///< by chunk, and one more
    SampleGuard guard_;
    GuardCounts counts_;
};

} // namespace fascicle::solver::fast
