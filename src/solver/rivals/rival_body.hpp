#pragma once
// What every rival method shares with xpbd, so that comparisons are of deformation alone (methods notes 6.5): attached vertices
// go exactly where their solids do, contact is that of xpbd (offset, hard bound, samples of faces and edges, planes of other
// muscles), the volume step is the same, and what is not finite is refused.
// A frame is cut into passes; in each: vertices are carried, deform(), volume step, contact.

#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/solver/soft_body_solver.hpp"
#include "solver/constraints/volume.hpp"
#include "solver/contact/contact_samples.hpp"
#include "solver/contact/sample_guard.hpp"
#include "solver/contact/solid_contact.hpp"

#include <cstdint>

namespace fascicle::solver {

class RivalBody : public SoftBodySolver {
public:
    /// Every solid must have its grid.
    explicit RivalBody(const SoftBodyProblem& problem);
    void advance(std::span<const Pose> from, std::span<const Pose> to) final;
    const Points& positions() const final { return x_; }
    const StepReport& report() const final { return report_; }
    const std::vector<int>& body_of_vertex() const final { return problem_.body_of_vertex; }
    bool takes_planes() const final { return true; }
    void set_planes(std::span<const PointPlane> planes) final {
        planes_.assign(planes.begin(), planes.end());
    }
    std::size_t state_bytes() const override;

protected:
    /// Moves the free vertices of x() to where the method wants them, for the solids' poses now. On entry attached vertices are
    /// in place and free ones are carried by carry_weights from where contact left them (before()).
    virtual void deform(double seconds) = 0;
    /// After volume step and contact, which may have moved the vertices: for methods that keep more than x().
    virtual void contacted() {}

    Points& x() { return x_; }
    const Points& rest() const { return problem_.surface->positions; }
    const Points& before() const { return before_; }
    const SoftBodyProblem& problem() const { return problem_; }
    const MeshTopology& topology() const { return topology_; }
    /// V: 0 for what is attached or of no triangle, else 1.
    const std::vector<double>& inverse_mass() const { return inverse_mass_; }
    bool is_free(std::size_t vertex) const { return inverse_mass_[vertex] != 0.0; }
    const std::vector<ContactSolid>& solids() const { return solids_; }
    /// V: unit normal of the solid that held a vertex at the end of the last pass, zero where none did.
    const Points& contact_normals() const { return normals_; }
    const ContactSettings& contact() const { return contact_; }
    /// For methods that seek equilibrium: this pass ended without it.
    void note_unconverged() { ++report_.unconverged; }
    double param(std::string_view key) const { return problem_.parameters.get(key); }

private:
    class Guarded;
    void pass(std::span<const Pose> from, std::span<const Pose> to, int k);
    void carry();
    void refuse_non_finite();
    void keep_volume();
    void hold_vertices(int k);
    void hold_samples(bool last);

    SoftBodyProblem problem_;
    MeshTopology topology_;
    std::vector<double> inverse_mass_;
    VolumeConstraint volume_;
    ContactSettings contact_;
    int passes_;
    Points x_, before_, frame_start_, normals_;
    std::vector<ContactSolid> solids_, frame_solids_; ///< during the pass, during the frame
    std::vector<PointPlane> planes_;                  ///< of this frame
    std::vector<ContactSample> samples_;
    std::vector<std::uint8_t> found_; ///< by sample: too near to a solid
    std::vector<ContactResult> touched_;
    SampleGuard guard_;
    GuardCounts vertex_counts_, sample_counts_;
    StepReport report_;
};

} // namespace fascicle::solver
