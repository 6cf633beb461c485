#pragma once
// Which particles are joined by springs.

#include "solver/rivals/mass_spring/particles.hpp"

namespace fascicle::mass_spring {

/// Order of the parameter mass-spring.springs.
enum class SpringLayout { lattice6, lattice26, nearest15 };

/// Undirected, a < b; rest: length, scene units, > 0.
struct Spring {
    int a = -1;
    int b = -1;
    double rest = 0;
};

/// lattice6, lattice26: from each particle to the nearest one in each of the 6 or 26 directions of the lattice's axes (a direction owns
/// what is nearer to it than to the others, up to 1.5 of its own length), so that inside these are the lattice's neighbours and at
/// the border what is there. nearest15: the 15 nearest, and others as near as the last. In all, springs leave the solid by no more than 0.15 of their length (at
/// the middle), and whoever then has fewer than 6 gets the nearest of the others. Parts of one component of
/// the surface that no spring joins are joined by the shortest one between boundary particles.
/// component: of the surface, by vertex (MeshTopology). Ascending by (a, b), no pair twice, none without length.
std::vector<Spring> make_springs(const ParticleSet& particles, SpringLayout layout, const SolidQuery& solid,
                                 const MeshTopology& topology);

} // namespace fascicle::mass_spring
