#pragma once
// The arrays of vertices that the fast kernel works on: made from a plan, and read back.

#include "fascicle/base/bytes_of.hpp"
#include "solver/fast/plan.hpp"
#include "solver/fast/row.hpp"

namespace fascicle::solver::fast {

class FastVertices {
public:
    FastVertices(const SoftBodyProblem& problem, const Plan& plan);

    /// rings: those of the plan.
    VertexArrays arrays(const std::uint16_t* rings) {
        return {records(), groups_.data(), reinterpret_cast<float*>(slack_.data()),
                carry_.empty() ? nullptr : reinterpret_cast<const float*>(carry_.data()), rings};
    }
    float* records() { return reinterpret_cast<float*>(records_.data()); }
    const float* records() const { return reinterpret_cast<const float*>(records_.data()); }
    /// Vertices of a chunk that are fixed to solids.
    std::span<const FixedGroup> fixed(std::size_t chunk) const {
        return {fixed_.data() + first_fixed_[chunk], first_fixed_[chunk + 1] - first_fixed_[chunk]};
    }

    /// SoftBodySolver::last_step() of `count` vertices, and set_state(); origin: the plan's.
    Points last_step(std::size_t count) const;
    void set_state(const Points& positions, const Points& last_step, const Vec3& origin);
    /// Positions of a range in the caller's order and frame.
    void collect(const GroupRange& range, std::span<const Pose> to, const SoftBodyProblem& problem,
                 const Vec3& origin, Points& positions) const;

    std::size_t bytes() const {
        return bytes_of(records_, groups_, slack_, carry_, fixed_, vertex_of_record_);
    }

private:
    void make_records(const Plan& plan);
    void make_groups(const SoftBodyProblem& problem, const Plan& plan);
    void make_fixed_groups(const SoftBodyProblem& problem, const Plan& plan);

    std::vector<Row> records_; ///< four rows of 16 floats per group: 16 records
    std::vector<VertexGroup> groups_;
    std::vector<Row> slack_, carry_;
    std::vector<FixedGroup> fixed_;
    std::vector<std::size_t> first_fixed_; ///< by chunk, and one more
    std::vector<int> vertex_of_record_;    ///< -1 for padding
};

} // namespace fascicle::solver::fast
