#include "fascicle/anatomy/fibre_methods.hpp"
namespace fascicle {
FibreModel decompose_streamlines(const FibreProblem&) { return {}; }
}
