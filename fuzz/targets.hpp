#pragma once
// The rows of every file of targets/, a group each. `targets()` of target.hpp joins them (all_targets.cpp), or is one of them:
// libFuzzer looks at all counters of a program after each execution, so that it has a program for each group.
// A new group: a file of targets/, a line here, in all_targets.cpp and in CMakeLists.txt.

#include "fuzz/target.hpp"

#include <vector>

namespace fascicle::fuzz {

std::vector<Target> mesh_targets(); ///< a row for each of mesh_formats(), and what is read from meshes
std::vector<Target> animation_targets();
std::vector<Target> table_targets();
std::vector<Target> scene_targets(); ///< what is read onto a scene
std::vector<Target> opensim_targets();
std::vector<Target> json_targets();
std::vector<Target> project_targets();
std::vector<Target> run_targets();
std::vector<Target> codec_targets();
std::vector<Target> option_targets();
std::vector<Target> command_line_targets();

} // namespace fascicle::fuzz
