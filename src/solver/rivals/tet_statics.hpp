#pragma once
// Equilibrium of a body of tetrahedra: the positions of least energy under pulls, obstacles and loads.

#include "solver/rivals/block_matrix.hpp"
#include "solver/rivals/embedding_lattice.hpp"
#include "solver/rivals/tet_elasticity.hpp"

#include <Eigen/SparseCholesky>
#include <memory>

namespace fascicle::solver {

/// k/2 |sum w_i x_i - target|^2: an attached point. stiffness: force per length.
struct TetPull {
    TetBinding at;
    Vec3 target = Vec3::Zero();
    double stiffness = 0;
};

/// k/2 max(0, depth)^2 of a point p beyond a plane, depth = level - out . p. out: unit. A plane and not the obstacle itself: the slope
/// of a distance grid jumps from cell to cell, and no step of Newton's method finds an equilibrium on such an edge.
struct TetTouch {
    TetBinding at;
    double stiffness = 0;
    Vec3 out = Vec3::UnitX();
    double level = 0;
};

/// stiffness/2 V0 (V / V0 - ratio)^2 of the volume V of all tetrahedra together, each by its fill; stiffness: a stress, 0: no such term.
struct TetVolume {
    double ratio = 1, stiffness = 0;
};

struct StaticsSettings {
    /// Ends when no unknown's force is larger than this share of young * spacing^2 ...
    double tolerance = 1e-4;
    int most_steps = 20;      ///< ... or after so many Newton steps
    double force_scale = 1.0; ///< young * spacing^2
    int threads = 1;
};

struct StaticsReport {
    int steps = 0;          ///< Newton steps of the last solve
    int inner = 0;          ///< steps of conjugate gradients in it
    int factors = 0;        ///< factorisations since the start
    double residual = 0;    ///< largest force on an unknown at the end, over force_scale
    bool converged = false; ///< residual <= tolerance
};

/// Newton's method on the whole energy, with the tangent made definite (tet_stiffness) and Armijo's line search. The linear systems are
/// solved by conjugate gradients, preconditioned with a Cholesky factor of an earlier tangent (its symbolic part is made once); it is
/// made anew when they take more than `stale_after` steps. The volume term couples all nodes: it is a product of two vectors beside the sparse
/// matrix. Sums are in the order of the tetrahedra: the same bits for any number of threads.
class TetStatics {
public:
    TetStatics(const Points& rest, std::vector<Tet> tets, const std::vector<double>& weights,
               const std::vector<Vec3>& fibres, const TetMaterial& material, const StaticsSettings& settings);

    /// s of active_inverse().
    void set_active_length(double s);
    std::vector<TetPull>& pulls() { return pulls_; }
    std::vector<TetTouch>& touches() { return touches_; }
    void set_volume(const TetVolume& volume) { volume_ = volume; }
    /// V / V0 at x.
    double volume_ratio(const Points& x) const;
    /// Forces on nodes (N), or empty.
    void set_loads(Points loads) { loads_ = std::move(loads); }
    /// 3 N: unknowns that keep their start value, or empty.
    void set_fixed(std::vector<std::uint8_t> fixed) { fixed_ = std::move(fixed); }
    /// N: nodes of parts that no pull holds, bound by a soft spring to where they are (N), or empty. Such a part has no equilibrium of its
    /// own: it stays where it is until something touches it.
    void set_loose(std::vector<std::uint8_t> loose, const Points& places) {
        loose_ = std::move(loose);
        start_ = places;
    }
    void set_loose_places(const Points& places) { start_ = places; }
    double loose_stiffness() const;

    /// x: N, start and result. Non-finite energies are stepped back from; a start that is not finite is an error of the caller.
    const StaticsReport& solve(Points& x);
    double energy(const Points& x) const;
    /// 3 N: dE/dx, zero where fixed.
    Eigen::VectorXd gradient(const Points& x) const;
    /// Tangent at x, without fixed unknowns and without the product of volume_slope() with itself that belongs to it.
    const Eigen::SparseMatrix<double>& stiffness(const Points& x, bool definite);
    /// 3 N: sqrt(stiffness / V0) dV/dx where stiffness() was made last, or of no length without a volume term.
    const Eigen::VectorXd& volume_slope() const { return slope_; }
    const StaticsReport& report() const { return report_; }
    std::size_t bytes() const;

    static constexpr int stale_after = 20;

private:
    std::array<Vec3, 4> corners(std::size_t tet, const Points& x) const;
    Vec3 bound(const TetBinding& at, const Points& x) const;
    double growth(const Points& x) const;
    double pressure_at(double growth) const;
    Eigen::VectorXd volume_gradient(const Points& x) const;
    void assemble(const Points& x, bool definite);
    void factor();
    /// Approximate solution of stiffness * step = right.
    Eigen::VectorXd solve_linear(const Eigen::VectorXd& right, double accuracy);
    /// Factor and volume term: (K + u u^T)^-1 r = z - w (u . z) / (1 + u . w), z = K^-1 r, w = K^-1 u (Sherman & Morrison 1950).
    Eigen::VectorXd precondition(const Eigen::VectorXd& right) const;
    bool conjugate_gradients(const Eigen::VectorXd& right, double accuracy, int most, Eigen::VectorXd& step);

    Points rest_;
    std::vector<Tet> tets_;
    std::vector<TetShape> rest_shapes_, shapes_; ///< without and with active fibres
    TetMaterial material_;
    StaticsSettings settings_;
    std::vector<std::array<int, 16>> places_; ///< of a tetrahedron's blocks in the matrix
    BlockMatrix matrix_;
    Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor_;
    bool analysed_ = false, factored_ = false;
    std::vector<TetPull> pulls_;
    std::vector<TetTouch> touches_;
    TetVolume volume_;
    double rest_volume_ = 0;
    Eigen::VectorXd slope_,
        solved_slope_; ///< 3 N: sqrt(stiffness / V0) dV/dx, and the factor's solution for it
    Points loads_, start_;
    std::vector<std::uint8_t> fixed_, loose_;
    StaticsReport report_;
};

} // namespace fascicle::solver
