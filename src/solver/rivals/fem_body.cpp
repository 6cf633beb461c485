#include "solver/rivals/fem_body.hpp"

#include "solver/rivals/lattice_body.hpp"
#include "solver/rivals/tet_statics.hpp"

#include <algorithm>

namespace fascicle::solver {

namespace {

class FemBody final : public LatticeBody {
public:
    explicit FemBody(const SoftBodyProblem& problem)
        : LatticeBody(problem, problem.parameters.get("fem.spacing_mm")), statics_(make_statics()) {
        const double young = param("fem.young_kpa"), spacing = lattice_.spacing;
        for (std::size_t i = 0; i < rest().size(); ++i) {
            const TetBinding& binding = lattice_.bindings[i];
            if (binding.tet < 0)
                continue;
            if (this->problem().body_of_vertex[i] >= 0) {
                attached_.push_back(i);
                statics_.pulls().push_back(
                    {binding, rest()[i], attachment_stiffness(young, vertex_areas()[i], spacing)});
                continue;
            }
            for (std::size_t b = 0; b < solids().size(); ++b) {
                touches_.push_back(b);
                statics_.touches().push_back({binding, contact_stiffness(young, vertex_areas()[i], spacing)});
            }
        }
        statics_.set_depth(
            [this](std::size_t touch, const Vec3& p, Vec3& out) { return depth(touch, p, out); });
        const auto loose = loose_nodes();
        if (std::find(loose.begin(), loose.end(), 1) != loose.end())
            statics_.set_loose(loose);
    }

    void set_active_length(double share) override { statics_.set_active_length(share); }
    std::size_t state_bytes() const override {
        return LatticeBody::state_bytes() + statics_.bytes() + bytes_of(attached_, touches_);
    }

protected:
    void deform(double) override {
        carry_nodes();
        for (std::size_t k = 0; k < attached_.size(); ++k)
            statics_.pulls()[k].target = attached_point(problem(), solids(), attached_[k]);
        statics_.solve(nodes_);
        skin();
    }

private:
    TetStatics make_statics() const {
        StaticsSettings settings;
        settings.force_scale = param("fem.young_kpa") * lattice_.spacing * lattice_.spacing;
        settings.tolerance = 1e-3;
        settings.most_steps = 8;
        settings.threads = problem().threads;
        return TetStatics(lattice_.nodes, lattice_.tets, lattice_.fill, fibres(),
                          material_from(param("fem.young_kpa"), param("fem.poisson"), param("fem.fibre_kpa")),
                          settings);
    }
    double depth(std::size_t touch, const Vec3& p, Vec3& out) const {
        const ContactSolid& solid = solids()[touches_[touch]];
        const DistanceSample sample = solid.grid->sample(solid.now.apply_inverse(p));
        out = solid.now.rotation * sample.gradient;
        return contact().offset - sample.value;
    }

    TetStatics statics_;
    std::vector<std::size_t> attached_; ///< vertex of each pull
    std::vector<std::size_t> touches_;  ///< solid of each touch
};

} // namespace

std::unique_ptr<SoftBodySolver> make_fem_solver(const SoftBodyProblem& problem) {
    return std::make_unique<FemBody>(problem);
}

} // namespace fascicle::solver
