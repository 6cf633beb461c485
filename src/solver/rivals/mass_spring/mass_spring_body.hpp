#pragma once
// The mass-spring rival: Janak's particle model behind the interface of all methods. docs/rivals/mass-spring.md

#include "solver/rivals/mass_spring/binding.hpp"
#include "solver/rivals/mass_spring/spring_net.hpp"
#include "solver/rivals/rival_body.hpp"

namespace fascicle {

/// For the table of methods. Parameters read, beside those of RivalBody: mass-spring.springs, .particles, .steps, .damping and the
/// method's passes a frame, over which the steps are spread.
std::unique_ptr<SoftBodySolver> make_mass_spring_solver(const SoftBodyProblem& problem);

namespace mass_spring {

class MassSpringBody final : public solver::RivalBody {
public:
    explicit MassSpringBody(const SoftBodyProblem& problem);
    std::size_t state_bytes() const override;
    /// Inner particles go where the boundary ones put them; all start at rest. last_step is not used.
    bool set_state(const Points& positions, const Points& last_step) override;

    const ParticleSet& particles() const { return particles_; }
    const SpringNet& net() const { return net_; }
    const Binding& binding() const { return binding_; }

protected:
    void deform(double seconds) override;
    void contacted() override;

private:
    void build(const SolidQuery& solid);
    void fit_carry();
    void carry_particles();
    void collide();
    void keep_volume();

    static constexpr double time_step = 0.4; ///< Janak's dt, in units of unit mass and SpringNet::unit()

    ParticleSet particles_;
    SpringNet net_;
    Binding binding_;
    std::vector<int> body_;     ///< P: solid a particle is fixed to, -1 free
    std::vector<double> carry_; ///< P x B, as carry_weights; empty: none
    solver::VolumeConstraint volume_;
    double damping_;
    int steps_, passes_, pass_ = 0;
    Points bound_;                            ///< V: the surface as the particles had it in this pass
    Points push_;                             ///< P: scratch
    std::vector<double> share_;               ///< P: scratch
    std::vector<char> stopped_;               ///< P: scratch
    std::vector<solver::ContactSolid> still_; ///< the solids of this pass, where they are at its end
    std::vector<double> clear_;               ///< P: within this distance of looked_at_ no solid is too near
    Points looked_at_;
};

} // namespace mass_spring
} // namespace fascicle
