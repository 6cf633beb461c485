#pragma once
// A sentence per figure, made from the data.

#include "reproduce/results.hpp"

namespace fascicle::reproduce {

/// kept: within a tenth of theirs, or both below what counts as none; better: smaller; worse: greater. Either not finite: shown.
Verdict judge(double ours, double theirs, double none_below);

/// Those figures of an experiment that are pictures (1 to 8), "3, 4"; empty: none.
std::string picture_figures(const Experiment& experiment);

/// Fills result.findings. What is judged is the program's own method against the published one in the same experiment (and, for the literal
/// repetitions, the published one against the published program's own numbers); the rivals' worst is named beside it.
void find_out(ExperimentResult& result);

} // namespace fascicle::reproduce
