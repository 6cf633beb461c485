#pragma once
// Does a result depend on how fine the mesh is, or on how many passes a frame has?

#include "reproduce/experiment_scene.hpp"
#include "reproduce/results.hpp"
#include "reproduce/work_folder.hpp"

namespace fascicle::reproduce {

struct SensitivityOptions {
    int frames = 50;             ///< of the way out; the measure is taken at its end
    bool with_parameters = true; ///< false: variants alone
};

/// The scene of an experiment with the program's own method: as given, remeshed evenly, with triangles halved and doubled (isotropic remeshing onto
/// the same surface), with passes halved and doubled; each with the method's real `solver.` parameters lowered by a fifth one by one. A run
/// that fails is told in its variant. Throws Cancelled.
SensitivityResult measure_sensitivity(const ExperimentScene& base, const std::string& experiment,
                                      const SensitivityOptions& options, const WorkFolder& work,
                                      const JobControl& control);

/// The muscle's surface with about this many triangles. Attachments that name vertices are carried over: a new vertex is attached where all
/// corners of the old triangle nearest to it are.
Muscle remeshed(const Muscle& muscle, int triangles);

/// Whether two effects of a parameter differ: by more than a quarter of the larger, and by more than `noise`.
bool effects_differ(double a, double b, double noise);

} // namespace fascicle::reproduce
