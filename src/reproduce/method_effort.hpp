#pragma once
// How many frames of the paper's 300 a method is given, so that the whole report stays within minutes.

#include "fascicle/base/param_table.hpp"
#include "reproduce/experiment.hpp"

namespace fascicle::reproduce {

/// Fixed numbers, never measured times: two runs of `reproduce` must give the same numbers on a quiet and on a busy machine. Methods that
/// the table of method_effort.cpp does not name get all 300. A divisor of 300 with frames at 0, 50, 100, ... of the paper's.
int frames_of(const std::string& method, bool is_short);

/// Coarser lattices and fewer alternations where a method would take minutes: in the short form, whose numbers mean nothing anyway, and
/// for single experiments. `parameters` are already the method's.
void set_effort(ParamSet& parameters, const std::string& experiment, const std::string& method,
                bool is_short);

/// The methods of the registry that run an experiment, among `wanted` (empty: all).
std::vector<std::string> methods_of(const Experiment& experiment, const std::vector<std::string>& wanted);

} // namespace fascicle::reproduce
