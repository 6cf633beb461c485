#pragma once
// The parameter table of a simulation: every row that `--set`, project files and the tuning panel know.

#include "fascicle/base/param_table.hpp"

namespace fascicle {

/// Rows in the order panels show them; documented in docs/parameters.md (a test keeps the two alike).
const ParamTable& parameter_table();

/// All defaults, for the method xpbd.
ParamSet default_parameters();

/// Switches solver.method and lets every value that was not edited follow the method's defaults. Nothing changes when the
/// method is in force already: a scene may bring defaults of its own.
/// Error (usage) when there is no such method.
void set_method(ParamSet& parameters, const std::string& method);

/// Why the method in force does not use a parameter, for people; empty when it does.
std::string unused_reason(const ParamSet& parameters, std::string_view key);

/// Passes a frame: solver.iterations, or the method's own number when that is 0.
int passes_per_frame(const ParamSet& parameters);

} // namespace fascicle
