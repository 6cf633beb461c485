#pragma once
// Whether a parameter does anything as the others are set.

#include "fascicle/scene/scene.hpp"

namespace fascicle::editor {

/// Why changing this row would change nothing now, as the end of a sentence; empty when it has an effect.
std::string no_effect_reason(const Scene& scene, const ParamRow& row);

/// Whether a row is of a method that is not in force, so that it need not be shown.
bool of_another_method(const Scene& scene, const ParamRow& row);

} // namespace fascicle::editor
