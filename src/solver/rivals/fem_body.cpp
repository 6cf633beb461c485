#include "solver/rivals/fem_body.hpp"

#include "fascicle/geometry/volume.hpp"
#include "solver/rivals/lattice_body.hpp"
#include "solver/rivals/tet_statics.hpp"

#include <algorithm>

namespace fascicle::solver {

namespace {

/// Multipliers of contact stay below so many spacings of depth: between solids that leave no room they would grow for ever.
constexpr double most_shift = 3.0;
/// Depth that contact leaves in the lattice, in spacings. A tetrahedron cannot follow a bone's curve more closely (the middle of a chord of a
/// spacing of 10 mm lies 0.5 mm inside a ball of 25 mm); multipliers that ask for it grow and grow. The surface's own contact takes it.
constexpr double depth_left = 0.05;
/// Stiffness of the volume term, in Young's moduli; its target is moved until the surface has its volume, so it only sets how fast.
constexpr double bulk = 50.0;
/// As contact has it: below this the gradient of a distance says nothing of the way out.
constexpr double least_slope = 0.3;
constexpr int most_steps = 18, contact_rounds = 3;

class FemBody final : public LatticeBody {
public:
    explicit FemBody(const SoftBodyProblem& problem)
        : LatticeBody(problem, problem.parameters.get("fem.spacing_mm")), statics_(make_statics()) {
        const double young = param("fem.young_kpa"), spacing = lattice_.spacing;
        for (std::size_t i = 0; i < rest().size(); ++i) {
            const TetBinding& binding = lattice_.bindings[i];
            if (binding.tet < 0 || this->problem().body_of_vertex[i] < 0)
                continue;
            attached_.push_back(i);
            statics_.pulls().push_back(
                {binding, rest()[i], attachment_stiffness(young, vertex_areas()[i], spacing)});
        }
        shifts_.assign(rest().size() * solids().size(), 0.0);
        const auto loose = loose_nodes();
        if (std::find(loose.begin(), loose.end(), 1) != loose.end())
            statics_.set_loose(loose, nodes_);
        rest_volume_ = signed_volume(rest(), this->problem().surface->triangles);
        wanted_ = param("solver.pressure");
        volume_kept_ = this->problem().parameters.get_choice("solver.volume") == "kept" && rest_volume_ > 0.0;
        volume_.ratio = wanted_;
        volume_.stiffness = volume_kept_ ? bulk * young : 0.0;
    }

    void set_active_length(double share) override { statics_.set_active_length(share); }
    std::size_t state_bytes() const override {
        return LatticeBody::state_bytes() + statics_.bytes() + bytes_of(attached_, touches_, shifts_);
    }

protected:
    /// Rounds of the method of multipliers: equilibrium with the planes and the volume term as they are, then planes, multipliers
    /// and the term's target anew, until forces, depths and the surface's volume are all as wanted.
    void deform(double) override {
        carry_nodes();
        for (std::size_t k = 0; k < attached_.size(); ++k)
            statics_.pulls()[k].target = attached_point(problem(), solids(), attached_[k]);
        statics_.set_loose_places(nodes_);
        place_touches();
        int steps = 0;
        for (int round = 0; steps < most_steps; ++round) {
            statics_.set_volume(volume_);
            const bool balanced = statics_.solve(nodes_).converged;
            steps += std::max(1, statics_.report().steps);
            skin();
            push_harder();
            const double deepest = place_touches();
            push_out();
            const double off = volume_kept_ ? volume_off() : 0.0;
            const bool held = deepest <= 2.0 * depth_left * lattice_.spacing || round + 1 >= contact_rounds;
            if (balanced && held && std::abs(off) <= volume_tolerance) {
                if (lost_ > 0)
                    break;
                return;
            }
            // Where bones leave no room for the volume it would grow without end, and push for ever after.
            volume_.ratio = std::clamp(volume_.ratio + off, 0.5 * wanted_, 2.0 * wanted_);
        }
        note_unconverged();
    }

private:
    static constexpr double volume_tolerance = 2e-4;

    TetStatics make_statics() const {
        StaticsSettings settings;
        settings.force_scale = param("fem.young_kpa") * lattice_.spacing * lattice_.spacing;
        settings.tolerance = 1e-3;
        settings.most_steps = 6;
        settings.threads = problem().threads;
        return TetStatics(lattice_.nodes, lattice_.tets, lattice_.fill, fibres(),
                          material_from(param("fem.young_kpa"), param("fem.poisson"), param("fem.fibre_kpa")),
                          settings);
    }
    /// What the surface's volume lacks, as a share of rest.
    double volume_off() const {
        return wanted_ - signed_volume(positions(), problem().surface->triangles) / rest_volume_;
    }
    /// Planes for what is near a solid now; the greatest depth below the contact offset. What is so deep that no way out shows has no
    /// plane and is counted.
    double place_touches() {
        touches_.clear();
        statics_.touches().clear();
        lost_ = 0;
        double deepest = 0.0;
        const double near = 0.5 * lattice_.spacing, young = param("fem.young_kpa");
        for (std::size_t i = 0; i < rest().size(); ++i) {
            if (!is_free(i) || lattice_.bindings[i].tet < 0)
                continue;
            const Vec3 p = lattice_.bound_point(i, nodes_);
            for (std::size_t b = 0; b < solids().size(); ++b) {
                const ContactSolid& solid = solids()[b];
                const std::size_t touch = i * solids().size() + b;
                const DistanceSample sample = solid.grid->sample(solid.now.apply_inverse(p));
                const double slope = sample.gradient.norm();
                if (contact().offset - sample.value < -near || slope < least_slope) {
                    shifts_[touch] = 0.0;
                    lost_ += sample.value < contact().offset ? 1 : 0;
                    continue;
                }
                const Vec3 out = solid.now.rotation * sample.gradient / slope;
                const double depth = (contact().offset - sample.value) / slope;
                deepest = std::max(deepest, depth);
                touches_.push_back(touch);
                statics_.touches().push_back({lattice_.bindings[i],
                                              contact_stiffness(young, vertex_areas()[i], lattice_.spacing),
                                              out, out.dot(p) + depth + shifts_[touch]});
            }
        }
        return deepest;
    }
    /// The surface as contact will leave it: what the lattice could not hold out, moved out alone.
    void push_out() {
        for (std::size_t k = 0; k < touches_.size(); ++k) {
            const std::size_t vertex = touches_[k] / solids().size();
            const TetTouch& touch = statics_.touches()[k];
            const double depth = touch.level - shifts_[touches_[k]] - touch.out.dot(x()[vertex]);
            if (depth > 0.0)
                x()[vertex] += depth * touch.out;
        }
    }
    /// Multipliers, as depths: what is in by more than is left to the surface's own contact stands in deeper from now on.
    void push_harder() {
        for (std::size_t k = 0; k < touches_.size(); ++k) {
            const TetTouch& touch = statics_.touches()[k];
            const double depth = touch.level - touch.out.dot(bound_at(touch.at));
            shifts_[touches_[k]] =
                std::clamp(depth - depth_left * lattice_.spacing, 0.0, most_shift * lattice_.spacing);
        }
    }
    Vec3 bound_at(const TetBinding& at) const {
        Vec3 p = Vec3::Zero();
        for (std::size_t k = 0; k < 4; ++k)
            p += at.weights[k] *
                 nodes_[static_cast<std::size_t>(lattice_.tets[static_cast<std::size_t>(at.tet)][k])];
        return p;
    }

    TetStatics statics_;
    std::vector<std::size_t> attached_; ///< vertex of each pull
    std::vector<std::size_t> touches_;  ///< place in shifts_ of each touch
    std::vector<double> shifts_;        ///< V x solids: multiplier over stiffness
    std::size_t lost_ = 0;              ///< vertices in solids without a plane
    double rest_volume_ = 0, wanted_ = 1;
    bool volume_kept_ = true;
    TetVolume volume_;
};

} // namespace

std::unique_ptr<SoftBodySolver> make_fem_solver(const SoftBodyProblem& problem) {
    return std::make_unique<FemBody>(problem);
}

} // namespace fascicle::solver
