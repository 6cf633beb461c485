#pragma once
// The ways of making fibres.

#include "fascicle/anatomy/fibre_problem.hpp"

namespace fascicle {

/// One row of the table that `fibres.method` chooses from.
struct FibreMethod {
    const char* key;
    const char* label;
    const char* meaning; ///< one sentence
    bool needs_template;
    bool needs_surface_fibres;
    FibreModel (*function)(const FibreProblem& problem);
};

/// In the order in which they are offered.
const std::vector<FibreMethod>& fibre_methods();

/// Kukacka decomposition (Kohout & Kukacka 2014): isolines of a harmonic field between the attachments, onto which the
/// cross-sections of a template are mapped by mean value coordinates. Error naming muscle and attachment when the
/// problem has no such field, or what is given is out of range.
FibreModel decompose_kukacka(const FibreProblem& problem);

/// Streamlines of a field that is harmonic in the muscle's volume, 0 at the origin and 1 at the insertion (after Choi &
/// Blemker 2013). Needs neither template nor surface fibres. Errors as above.
FibreModel decompose_streamlines(const FibreProblem& problem);

/// CHMD (Kohout & Cholt 2017): from at least two superficial fibres, a layer splined across them, copies of it through
/// the muscle's thickness, and each fibre led to a place of its own on the attachments. Several heads are told apart by
/// the gaps between them. The surface must be closed. Needs no template. Errors as above, and for surface fibres that
/// are too few, too short, or not this muscle's.
FibreModel decompose_chmd(const FibreProblem& problem);

} // namespace fascicle
