#pragma once
// A sentence per figure, made from the data.

#include "reproduce/results.hpp"

namespace fascicle::reproduce {

/// kept: within a tenth of theirs, or both below what counts as none; better: smaller; worse: greater. Either not finite: shown.
Verdict judge(double ours, double theirs, double none_below);

/// Those figures of an experiment that are pictures (1 to 8), "3, 4"; empty: none.
std::string picture_figures(const Experiment& experiment);

/// The paper plots volume, edges and dihedrals (`group` 0, 1, 2) of box, iliacus and gluteus maximus, in this order: figures 11 to 19.
/// Empty for any other.
std::string plot_figure(const Experiment& experiment, int group);
/// Of the plot of fibre lengths: 20, 21, or empty.
std::string fibre_figure(const Experiment& experiment);
/// Finding::about of a method's fibre lengths.
std::string fibre_lengths_about(const std::string& method);
/// The decomposition's name for people.
std::string fibre_method(const Experiment& experiment);

/// Fills result.findings. What is judged is the program's own method against the published one in the same experiment (and, for the literal
/// repetitions, the published one against the published program's own numbers); the rivals' worst is named beside it.
void find_out(ExperimentResult& result);

/// The paper's statement is the order alone: the more triangles, the fewer frames. Its own correlation is that of published_speeds().
Finding judge_speed(const SpeedResult& speed);

} // namespace fascicle::reproduce
