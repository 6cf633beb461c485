#pragma once
// The coarse correction (solver/coarse/coarse_correction.hpp: what it is and why) in the fast kernel's arrays. A step has parts that all
// threads take a share of, with a meeting after each, and one part for a single thread.

#include "solver/coarse/coarse_matrix.hpp"
#include "solver/fast/plan.hpp"
#include "solver/fast/row.hpp"

#include <optional>

namespace fascicle::solver::fast {

class FastCoarse {
public:
    /// matrix without clusters: empty(), and nothing else may be called. plan and kernels must outlive this.
    FastCoarse(const SoftBodyProblem& problem, const MeshTopology& topology, CoarseMatrix matrix,
               const Plan& plan, const Kernels& kernels);
    FastCoarse(const FastCoarse&) = delete;
    FastCoarse& operator=(const FastCoarse&) = delete;

    bool empty() const { return matrix_.empty(); }

    /// For every chunk: forces to zero.
    void clear(const GroupRange& range);
    /// For every set of constraints, interfaces after interiors: their forces.
    void push(const float* records, const ConstraintSet& set);
    /// For every chunk, after the volume's gradients: what the step has to balance.
    void load(const VertexArrays& v, const GroupRange& range);
    /// By every thread, its share of the clusters: forces, and, when with_frames, where they are and how they are turned.
    void sum(const float* records, int thread, int threads, bool with_frames);
    /// By one thread: takes the frames, and decides whether the matrix has to be made anew. with_frames as in sum().
    void prepare(const VertexArrays& v, bool with_frames);
    /// Whether it has; then for every part of the matrix:
    bool renew() const { return renew_; }
    void add_part(std::size_t part) {
        matrix_.add_part(part, matrix_.basis().reference(), terms_, mass_, normals_);
    }
    /// By one thread: the motion of the clusters. volume_error: V minus the wanted one, nothing: any volume will do;
    /// with_frames as in sum().
    void solve(std::optional<double> volume_error, bool with_frames);
    /// For every chunk, numbered: displacements.
    void spread(const VertexArrays& v, const GroupRange& range, std::size_t chunk);
    /// For every set, numbered with the interfaces behind the interiors: how stiff the body is along the displacement.
    void bend(const float* records, const ConstraintSet& set, std::size_t number);
    /// By every thread alike: how far to go along the displacement.
    double length() const;
    /// For every chunk.
    void apply(const VertexArrays& v, const GroupRange& range, double length);
    /// By one thread, at the end of the step.
    void conclude(double length);

    std::size_t bytes() const;
    std::int64_t assemblies() const { return assemblies_; }

private:
    void make_members(const Plan& plan);
    void sum_cluster(const float* records, std::size_t cluster, bool with_frames);
    void copy_state(const VertexArrays& v);

    const Plan& plan_;
    const Kernels& kernels_;
    CoarseMatrix matrix_;
    DihedralConstraints hinges_; ///< in double, for the matrix
    std::vector<DistanceConstraint> edges_;
    ElasticTerms terms_;
    HingeSprings springs_{};
    std::vector<Row> forces_, moves_, reference_; ///< records; moves_ holds the volume's gradients before
    std::vector<std::vector<MemberPacket>> members_;
    std::vector<std::size_t> order_, work_before_; ///< clusters as threads take them, packets before each
    std::vector<CoarseShare> shares_;
    std::vector<Row> motion_; ///< two records a cluster: displacement of the origin, turn
    struct alignas(64) ClusterSums {
        float load[12]; ///< force, moment; of the volume gradient
        float shape[12];
        float centre[3], centres[6];
    };
    std::vector<ClusterSums> sums_;
    std::vector<float> q_, r_, qg_, g_;
    std::vector<double> squares_, stiffness_; ///< by chunk, by set
    std::vector<double> mass_;                ///< V, inverse
    Points normals_;                          ///< what the matrix is made of
    double pressure_ = 0, more_ = 0, slope_ = 0;
    double gain_ = 0; ///< of the volume along qg_ when that was solved for
    bool stale_ = true, renew_ = false;
    int age_ = 0;
    std::int64_t steps_ = 0, assemblies_ = 0;
};

} // namespace fascicle::solver::fast
