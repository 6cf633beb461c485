#pragma once
// From a row of experiments() to a scene that can be run.

#include "fascicle/scene/scene.hpp"
#include "reproduce/data_files.hpp"
#include "reproduce/experiment.hpp"

#include <set>

namespace fascicle::reproduce {

/// The scene of an experiment, with one muscle and the parameters of no method yet.
struct ExperimentScene {
    Scene scene;
    bool real = false;                      ///< from the public data; false: the embedded stand-in
    std::vector<std::string> notes;         ///< of reading, a sentence each
    std::set<std::filesystem::path> inputs; ///< files that were read
    std::string missing;                    ///< why there is no scene, a sentence; empty: there is one
};

/// threads: for reading; changes nothing in the result. Errors of bad files are thrown; files that are not there are `missing`.
ExperimentScene make_experiment_scene(const Experiment& experiment, const DataFiles& data, int threads);

/// The same motion in fewer or more frames: what happens in frame k happens in frame k frames / last_frame. frames >= 1.
Timeline in_frames(const Timeline& timeline, int frames);

} // namespace fascicle::reproduce
