#pragma once
// The matrix of the coarse correction, P^T (1 + H) P, and its factor, in frames that turn with the clusters.

#include "solver/coarse/banded_cholesky.hpp"
#include "solver/coarse/block_sum.hpp"
#include "solver/coarse/cluster_basis.hpp"
#include "solver/coarse/coarse_step.hpp"
#include "solver/coarse/elastic_terms.hpp"

namespace fascicle::solver {

class CoarseMatrix {
public:
    /// The matrix is a sum of so many parts, which may be made side by side; the result does not depend on it.
    static constexpr std::size_t parts = 2;

    CoarseMatrix() = default;
    CoarseMatrix(const Points& rest, const MeshTopology& topology, const std::vector<double>& inverse_mass,
                 int clusters, int substeps)
        : basis_(rest, topology, inverse_mass, clusters), far_bend_(far_bend_rad(substeps)) {}

    bool empty() const { return basis_.clusters() == 0; }
    ClusterBasis& basis() { return basis_; }
    const ClusterBasis& basis() const { return basis_; }

    /// Sorts the terms and finds which clusters meet; begin() does it when nobody has.
    void prepare(const ElasticTerms& terms);
    /// Makes and factors the matrix at x, which becomes the reference of the clusters' frames. normals: V unit normals of
    /// contacts, zero where there is none, or empty. The same as begin(), add_part() for every part, finish().
    void assemble(const Points& x, const ElasticTerms& terms, const std::vector<double>& inverse_mass,
                  const Points& normals);
    void begin(const Points& x, const ElasticTerms& terms);
    void add_part(std::size_t part, const Points& x, const ElasticTerms& terms,
                  const std::vector<double>& inverse_mass, const Points& normals);
    void finish();

    /// Whether the clusters have turned so much against each other since assemble() that a new one is due.
    bool outdated() const { return basis_.mean_bend() > far_bend_; }
    /// In place, in the turned frames.
    void solve(std::span<float> b) const { factor_.solve(b); }
    std::size_t bytes() const {
        return basis_.bytes() + pattern_.bytes() + factor_.bytes() +
               parts * (sums_[0].bytes() + bytes_of(moments_[0])) + bytes_of(edges_, hinges_);
    }

private:
    void find_pattern(const ElasticTerms& terms);
    void add(BlockSum& sum, const Points& x, const ElasticTerm& term, double weight) const;
    void add_inertia(std::size_t part, const Points& x, std::size_t first, std::size_t end);

    /// Sums over the vertices that two clusters share, with x from the centre of the lower one: w w times 1, x, y, z, xx, xy, xz, yy,
    /// yz, zz.
    using PairMoments = std::array<double, 10>;

    ClusterBasis basis_;
    double far_bend_ = 0;
    BlockPattern pattern_;
    std::array<std::vector<PairMoments>, parts> moments_; ///< by the pairs of the pattern
    std::array<BlockSum, parts> sums_;
    BandedCholesky factor_;
    /// Numbers of edges and hinges, those of the same clusters together: they meet in the same places of the matrix.
    std::vector<int> edges_, hinges_;
    std::uint32_t edge_stride_ = 1, hinge_stride_ = 1; ///< one in so many makes the matrix
    std::uint32_t assemblies_ = 0;
};

} // namespace fascicle::solver
