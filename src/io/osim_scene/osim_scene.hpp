#pragma once
// A scene from an OpenSim model and a trial.

#include "fascicle/io/load_scene.hpp"

namespace fascicle::io {

/// Error (usage) for options that do not go with --osim, or that it needs.
void check_osim_request(const SceneRequest& request);
/// Error (usage) for options that only go with it.
void require_no_osim_options(const OsimRequest& request);

/// Bones, muscles, motion and line muscles. With a table of poses (.csv) for a motion the timeline is left to the caller
/// (scene.model_motion stays null), and there are no line muscles.
LoadedScene load_osim_scene(const SceneRequest& request, const JobControl& control);

/// For a project, which tells mesh_frame, axes, the rotation of ground, reading, and then bone_of_body: the model; the posture at rest and
/// the frames of the trial. Error as the readers.
void read_model_of(ModelMotion& motion, const std::filesystem::path& model);
void read_trial_of(ModelMotion& motion, const std::filesystem::path& trial, std::vector<std::string>& notes);

/// The model's muscles as lines, placed by the motion.
std::shared_ptr<const LineMuscles> model_lines(const ModelMotion& motion);

} // namespace fascicle::io
