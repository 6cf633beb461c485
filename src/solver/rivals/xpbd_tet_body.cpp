#include "solver/rivals/xpbd_tet_body.hpp"

#include "solver/rivals/lattice_body.hpp"
#include "solver/rivals/lattice_fields.hpp"
#include "solver/rivals/tet_constraints.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::solver {

namespace {

std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

/// Density of muscle, kg/mm^3 (methods notes, section 7: 1.056 g/cm3).
constexpr double density = 1.056e-6;
/// Below this it may be a last volume step as well.
constexpr double least_push_mm = 1e-3;
/// Damping of a pass beyond which the speed before it cannot be told any more: e^30 is enough.
constexpr double most_damped = 30;
/// Volume and contact in turn, in a substep.
constexpr int contact_rounds = 3;

class XpbdTetBody final : public LatticeBody {
public:
    explicit XpbdTetBody(const SoftBodyProblem& problem)
        : LatticeBody(problem, problem.parameters.get("xpbd-tet.spacing_mm")),
          material_(material_from(param("xpbd-tet.young_kpa"), param("xpbd-tet.poisson"),
                                  param("xpbd-tet.fibre_kpa"))),
          volume_(problem.surface->positions, problem.surface->triangles,
                  problem.parameters.get("solver.pressure"),
                  problem.parameters.get_choice("solver.volume") == "kept"),
          scale_(problem.unit_mm), damping_(param("solver.damping")),
          seconds_(param("solver.frame_time") / passes_per_frame(problem.parameters)),
          ratio_(param("solver.pressure")), before_nodes_(nodes_), carried_(nodes_),
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
    Points last_step() const override {
        Points moves = velocity_;
        for (Vec3& move : moves)
            move *= std::exp(std::min(damping_ * seconds_, most_damped)) * seconds_;
        Points steps(rest().size(), Vec3::Zero());
        for (std::size_t i = 0; i < steps.size(); ++i)
            if (lattice_.bindings[i].tet >= 0)
                steps[i] = lattice_.bound_point(i, moves);
        return steps;
    }
    bool set_state(const Points& positions, const Points& last_step) override {
        if (!LatticeBody::set_state(positions, last_step))
            return false;
        if (last_step.size() != positions.size()) // from a method that knows no speeds
            return true;
        std::vector<double> steps, counts;
        for (std::size_t i = 0; i < last_step.size(); ++i) {
            steps.insert(steps.end(), {last_step[i].x(), last_step[i].y(), last_step[i].z()});
            counts.push_back(lattice_.bindings[i].tet < 0 ? 0.0 : 1.0);
        }
        const std::vector<double> moves = node_values(lattice_, steps, 3, counts, 0);
        const double keep = std::exp(-damping_ * seconds_) / seconds_;
        for (std::size_t n = 0; n < nodes_.size(); ++n)
            velocity_[n] = keep * Vec3(moves[3 * n], moves[3 * n + 1], moves[3 * n + 2]);
        return true;
    }
    std::size_t state_bytes() const override {
        return LatticeBody::state_bytes() +
               bytes_of(rest_shapes_, shapes_, before_nodes_, carried_, velocity_, untouched_, skinned_,
                        node_inverse_mass_, slope_, stops_) +
               volume_.bytes();
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
        for (int round = 0; round < contact_rounds; ++round) {
            if (volume_.kept())
                keep_lattice_volume();
            hold_out();
        }
        for (std::size_t i = 0; i < rest().size(); ++i)
            if (problem().body_of_vertex[i] >= 0)
                bring(i, attached_point(problem(), solids(), i));
        skin();
        skinned_ = x();
        lacking_ = volume_.wanted_volume() - volume_.evaluate(x());
        keep_volume_here();
        untouched_ = x();
    }

    /// What contact did to the surface goes to the nodes; then velocities follow from the way of the nodes. Only what it moved: were the
    /// others brought to where they are, they would hold the tissue in the bone's way. What the volume step did stays with the
    /// surface: the tetrahedra keep volumes of their own.
    void contacted() override {
        for (std::size_t i = 0; i < x().size(); ++i)
            if (is_free(i) && (x()[i] - untouched_[i]).norm() * scale_ > least_push_mm)
                bring(i, skinned_[i] + x()[i] - untouched_[i]);
        if (volume_.kept()) { // what contact took away, too, the lattice is to make up for
            lacking_ += volume_.wanted_volume() - volume_.evaluate(x());
            ratio_ = std::clamp(ratio_ + 0.2 * lacking_ / volume_.rest_volume(), 0.5, 3.0);
        }
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
    /// The volume of all tetrahedra as one constraint without compliance, C = sum V (det F - 1) - V0 (ratio - 1), dx = -w g C / sum w g^2.
    /// ratio follows the surface's volume, so that the surface has its own. Nodes do not move against contact.
    void keep_lattice_volume() {
        slope_.assign(nodes_.size(), Vec3::Zero());
        double growth = 0.0, rest_volume = 0.0;
        for (std::size_t t = 0; t < lattice_.tets.size(); ++t) {
            const TetConstraint c = volume_change(shapes_[t], corners(t));
            growth += shapes_[t].volume * c.value;
            rest_volume += shapes_[t].volume;
            for (std::size_t k = 0; k < 4; ++k)
                slope_[at(lattice_.tets[t][k])] += shapes_[t].volume * c.gradient[k];
        }
        const double off =
            std::clamp(growth - rest_volume * (ratio_ - 1.0), -0.1 * rest_volume, 0.1 * rest_volume);
        stops_.assign(nodes_.size(), Vec3::Zero());
        for (std::size_t i = 0; i < rest().size(); ++i)
            if (lattice_.bindings[i].tet >= 0 && !contact_normals()[i].isZero(0.0))
                for (std::size_t k = 0; k < 4; ++k)
                    stops_[at(lattice_.tets[at(lattice_.bindings[i].tet)][k])] +=
                        std::max(0.0, lattice_.bindings[i].weights[k]) * contact_normals()[i];
        double weight = 0.0;
        for (std::size_t n = 0; n < nodes_.size(); ++n) {
            if (const double size = stops_[n].norm(); size > 0.0) {
                const Vec3 normal = stops_[n] / size;
                if (const double along = slope_[n].dot(normal); - off * along < 0.0)
                    slope_[n] -= along * normal;
            }
            weight += node_inverse_mass_[n] * slope_[n].squaredNorm();
        }
        if (!(weight > 0.0))
            return;
        for (std::size_t n = 0; n < nodes_.size(); ++n)
            nodes_[n] -= off / weight * node_inverse_mass_[n] * slope_[n];
    }
    /// As the base does it after this: done here, so that contacted() can tell what contact moved.
    void keep_volume_here() {
        constexpr int most_steps = 4;
        for (int step = 0; step < most_steps && volume_.kept(); ++step) {
            const double off = volume_.evaluate(x()) - volume_.wanted_volume();
            if (std::abs(off) <= 1e-6 * std::abs(volume_.rest_volume()))
                return;
            volume_.project(x(), inverse_mass(), contact_normals());
        }
    }
    /// Contact of the surface brought to the nodes at once, vertex by vertex: what is left to the base's contact is lost volume, since
    /// that comes last.
    void hold_out() {
        if (solids().empty())
            return;
        for (std::size_t i = 0; i < rest().size(); ++i) {
            if (!is_free(i) || lattice_.bindings[i].tet < 0)
                continue;
            Vec3 p = lattice_.bound_point(i, nodes_);
            if (!p.allFinite())
                continue;
            const ContactResult result = resolve_contact(p, before()[i], solids(), contact());
            if (result.touched)
                bring(i, p);
        }
    }
    void bring(std::size_t vertex, const Vec3& target) {
        const TetBinding& binding = lattice_.bindings[vertex];
        if (binding.tet < 0)
            return;
        TetPoints x = corners(at(binding.tet));
        // All corners alike: by their masses the light ones outside of the surface would be flung about.
        project_point(x, binding.weights, target, {1.0, 1.0, 1.0, 1.0});
        put(at(binding.tet), x);
    }

    TetMaterial material_;
    VolumeConstraint volume_;
    double scale_, damping_;
    double seconds_; ///< of a substep
    double ratio_;   ///< wanted volume of the lattice, in those at rest
    bool forward_ = false;
    std::vector<TetShape> rest_shapes_, shapes_; ///< without and with active fibres
    Points before_nodes_, carried_, velocity_;
    Points slope_, stops_;                  ///< of the volume by the nodes; sums of contact normals
    double lacking_ = 0.0;                  ///< volume of the surface in its lattice
    Points skinned_;                        ///< the surface in its lattice
    Points untouched_;                      ///< the surface before contact
    std::vector<double> node_inverse_mass_; ///< 1 / kg
};

} // namespace

std::unique_ptr<SoftBodySolver> make_xpbd_tet_solver(const SoftBodyProblem& problem) {
    return std::make_unique<XpbdTetBody>(problem);
}

} // namespace fascicle::solver
