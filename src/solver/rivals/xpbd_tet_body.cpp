#include "solver/rivals/xpbd_tet_body.hpp"

#include "solver/rivals/lattice_body.hpp"
#include "solver/rivals/tet_constraints.hpp"

#include <cmath>

namespace fascicle::solver {

namespace {

std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

/// Density of muscle, kg/mm^3 (methods notes, section 7: 1.056 g/cm3).
constexpr double density = 1.056e-6;

class XpbdTetBody final : public LatticeBody {
public:
    explicit XpbdTetBody(const SoftBodyProblem& problem)
        : LatticeBody(problem, problem.parameters.get("xpbd-tet.spacing_mm")),
          material_(material_from(param("xpbd-tet.young_kpa"), param("xpbd-tet.poisson"),
                                  param("xpbd-tet.fibre_kpa"))),
          scale_(problem.unit_mm), damping_(param("solver.damping")), before_nodes_(nodes_), carried_(nodes_),
          velocity_(nodes_.size(), Vec3::Zero()), node_inverse_mass_(nodes_.size(), 0.0) {
        for (std::size_t t = 0; t < lattice_.tets.size(); ++t) {
            rest_shapes_.push_back(tet_shape(corners(t), lattice_.fill[t], fibres()[t]));
            const double mass = density * rest_shapes_.back().volume * scale_ * scale_ * scale_;
            for (const int node : lattice_.tets[t])
                node_inverse_mass_[at(node)] += mass / 4.0;
        }
        for (double& w : node_inverse_mass_)
            w = 1.0 / w;
        shapes_ = rest_shapes_;
    }

    void set_active_length(double share) override {
        shapes_ = rest_shapes_;
        for (TetShape& shape : shapes_)
            if (share != 1.0 && !shape.fibre.isZero(0.0)) {
                const Mat3 inverse = active_inverse(shape.fibre, share);
                for (Vec3& g : shape.gradients)
                    g = inverse.transpose() * g;
            }
    }
    std::size_t state_bytes() const override {
        return LatticeBody::state_bytes() +
               bytes_of(rest_shapes_, shapes_, before_nodes_, carried_, velocity_, node_inverse_mass_);
    }

protected:
    void deform(double seconds) override {
        seconds_ = seconds;
        before_nodes_ = nodes_;
        carry_nodes();
        for (std::size_t n = 0; n < nodes_.size(); ++n) {
            carried_[n] = nodes_[n] - before_nodes_[n];
            nodes_[n] += seconds * velocity_[n];
        }
        sweep();
        for (std::size_t i = 0; i < rest().size(); ++i)
            if (problem().body_of_vertex[i] >= 0)
                bring(i, attached_point(problem(), solids(), i));
        skin();
    }

    /// What volume step and contact did to the surface goes to the nodes; then velocities follow from the way of the nodes.
    void contacted() override {
        for (std::size_t i = 0; i < x().size(); ++i)
            if (is_free(i))
                bring(i, x()[i]);
        const double keep = std::exp(-damping_ * seconds_) / seconds_;
        for (std::size_t n = 0; n < nodes_.size(); ++n) {
            if (!nodes_[n].allFinite()) { // refused where it is born
                nodes_[n] = before_nodes_[n];
                velocity_[n].setZero();
                continue;
            }
            velocity_[n] = keep * (nodes_[n] - before_nodes_[n] - carried_[n]);
        }
    }

private:
    TetPoints corners(std::size_t t) const {
        const Tet& tet = lattice_.tets[t];
        return {nodes_[at(tet[0])], nodes_[at(tet[1])], nodes_[at(tet[2])], nodes_[at(tet[3])]};
    }
    std::array<double, 4> inverse_masses_of(std::size_t t) const {
        const Tet& tet = lattice_.tets[t];
        return {node_inverse_mass_[at(tet[0])], node_inverse_mass_[at(tet[1])],
                node_inverse_mass_[at(tet[2])], node_inverse_mass_[at(tet[3])]};
    }
    void put(std::size_t t, const TetPoints& x) {
        for (std::size_t k = 0; k < 4; ++k)
            nodes_[at(lattice_.tets[t][k])] = x[k];
    }
    /// Every tetrahedron once, one after the other; the direction changes from pass to pass, so that none is preferred.
    void sweep() {
        forward_ = !forward_;
        const std::size_t count = lattice_.tets.size();
        for (std::size_t k = 0; k < count; ++k) {
            const std::size_t t = forward_ ? k : count - 1 - k;
            TetPoints x = corners(t);
            project_tet(material_, shapes_[t], x, inverse_masses_of(t), seconds_, scale_);
            put(t, x);
        }
    }
    void bring(std::size_t vertex, const Vec3& target) {
        const TetBinding& binding = lattice_.bindings[vertex];
        if (binding.tet < 0)
            return;
        TetPoints x = corners(at(binding.tet));
        project_point(x, binding.weights, target, inverse_masses_of(at(binding.tet)));
        put(at(binding.tet), x);
    }

    TetMaterial material_;
    double scale_, damping_;
    double seconds_ = 1.0;
    bool forward_ = false;
    std::vector<TetShape> rest_shapes_, shapes_; ///< without and with active fibres
    Points before_nodes_, carried_, velocity_;
    std::vector<double> node_inverse_mass_; ///< 1 / kg
};

} // namespace

std::unique_ptr<SoftBodySolver> make_xpbd_tet_solver(const SoftBodyProblem& problem) {
    return std::make_unique<XpbdTetBody>(problem);
}

} // namespace fascicle::solver
