#pragma once
// What made a run, in short, for files that leave the program: no paths of the user's.

#include "fascicle/scene/recording.hpp"

#include <string>

namespace fascicle {

/// A JSON object on one line: scene, method, unit, state hash, parameters, program.
std::string run_provenance(const Recording& recording);

} // namespace fascicle
