#pragma once
// The parameter table of a simulation: every row that `--set`, project files and the tuning panel know.

#include "fascicle/base/param_table.hpp"

namespace fascicle {

/// Rows in the order panels show them; documented in docs/parameters.md (a test keeps the two alike).
const ParamTable& parameter_table();

/// All defaults, for the method xpbd.
ParamSet default_parameters();

/// Switches solver.method and lets every value that was not edited follow the method's defaults, or what a scene has brought
/// in their place. Nothing else changes when the method is in force already.
/// Error (usage) when there is no such method.
void set_method(ParamSet& parameters, const std::string& method);

/// Defaults of a scene in the place of those of the method in force; they come back with the method when another was used
/// between. Takes any value: the scene's author answers for them.
void bring_defaults(ParamSet& parameters, const ParamSet::Defaults& defaults);

/// Why the method in force does not use a parameter, for people; empty when it does.
std::string unused_reason(const ParamSet& parameters, std::string_view key);

/// Passes a frame: solver.iterations, or the method's own number when that is 0.
int passes_per_frame(const ParamSet& parameters);

} // namespace fascicle
