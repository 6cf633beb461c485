#pragma once
// What the plain and the fast kernel both make of a problem for its contacts.

#include "fascicle/solver/soft_body_solver.hpp"
#include "solver/contact/contact_samples.hpp"
#include "solver/contact/solid_contact.hpp"
#include "solver/edge_constraints.hpp"

namespace fascicle::solver {

/// Faces are sampled at least this densely: a bone's ridge of 5 mm radius stands 0.4 mm out of a chord of 4 mm.
inline constexpr double face_spacing_mm = 4.0;
inline constexpr double edge_spacing_mm = 2.5;

inline ContactSettings contact_settings(const SoftBodyProblem& problem) {
    ContactSettings settings;
    settings.offset = problem.parameters.get("contact.offset_mm") / problem.unit_mm;
    settings.least = least_of_offset * settings.offset;
    settings.friction = problem.parameters.get("contact.friction");
    return settings;
}

/// Corners are vertices. Every solid must have its grid.
inline std::vector<ContactSample> contact_samples_of(const SoftBodyProblem& problem,
                                                     const MeshTopology& topology) {
    const TriMesh& surface = *problem.surface;
    std::vector<ContactSample> samples = make_contact_samples(
        surface.positions, surface.triangles, topology, inverse_masses(problem, topology),
        face_spacing_mm / problem.unit_mm, edge_spacing_mm / problem.unit_mm);
    std::vector<const DistanceGrid*> grids;
    for (const SolidBody& body : problem.solids)
        grids.push_back(body.grid.get());
    set_sample_limits(samples, surface.positions, grids, contact_settings(problem).least);
    return samples;
}

} // namespace fascicle::solver
