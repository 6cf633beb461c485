#pragma once
// The matrix of the coarse correction, P^T (1 + H) P, and its factor, in frames that turn with the clusters.

#include "solver/coarse/banded_cholesky.hpp"
#include "solver/coarse/cluster_basis.hpp"
#include "solver/coarse/elastic_terms.hpp"

namespace fascicle::solver {

class CoarseMatrix {
public:
    /// The matrix is a sum of so many parts, which may be made side by side; the result does not depend on it.
    static constexpr std::size_t parts = 2;

    CoarseMatrix() = default;
    CoarseMatrix(const Points& rest, const MeshTopology& topology, const std::vector<double>& inverse_mass,
                 int clusters)
        : basis_(rest, topology, inverse_mass, clusters) {}

    bool empty() const { return basis_.clusters() == 0; }
    ClusterBasis& basis() { return basis_; }
    const ClusterBasis& basis() const { return basis_; }

    /// Makes and factors the matrix at x, which becomes the reference of the clusters' frames. normals: V unit normals of
    /// contacts, zero where there is none, or empty. The same as begin(), add_part() for every part, finish().
    void assemble(const Points& x, const ElasticTerms& terms, const std::vector<double>& inverse_mass,
                  const Points& normals);
    void begin(const Points& x, const ElasticTerms& terms);
    void add_part(std::size_t part, const Points& x, const ElasticTerms& terms,
                  const std::vector<double>& inverse_mass, const Points& normals);
    void finish();

    /// Two right-hand sides at once, in place, in the turned frames.
    void solve(std::span<float> b0, std::span<float> b1) const { sums_[0].solve(b0, b1); }
    std::size_t bytes() const {
        return basis_.bytes() + parts * sums_[0].bytes() + bytes_of(edges_, hinges_);
    }

private:
    void sort_terms(const ElasticTerms& terms);
    void add(BandedCholesky& sum, const Points& x, const ElasticTerm& term, double weight) const;
    void add_inertia(std::size_t part, const Points& x, std::size_t first, std::size_t end);

    /// Sums over the vertices that two clusters share, with x from the centre of the lower one: w w, w w x, w w x x^T.
    struct PairMoments {
        double zeroth = 0;
        Vec3 first = Vec3::Zero();
        Mat3 second = Mat3::Zero();
    };

    ClusterBasis basis_;
    std::array<std::vector<PairMoments>, parts> pairs_; ///< lower cluster by difference to the higher one
    std::array<BandedCholesky, parts> sums_;            ///< the first holds the factor in the end
    /// Numbers of edges and hinges, those of the same clusters together: they meet in the same places of the matrix.
    std::vector<int> edges_, hinges_;
    std::uint32_t edge_stride_ = 1, hinge_stride_ = 1; ///< one in so many makes the matrix
    std::uint32_t assemblies_ = 0;
};

} // namespace fascicle::solver
