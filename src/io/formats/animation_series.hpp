#pragma once
// Animations as many files: an OBJ of every frame, a VTP of every body and frame with a PVD, a point cache beside an OBJ.

#include "fascicle/io/animation_file.hpp"

namespace fascicle::io {

using WriteTarget = const std::filesystem::path&;

/// NAME_0012.obj: all bodies as objects, numbers that read back the same.
void write_obj_series(WriteTarget folder, const Animation& animation, const AnimationOptions& options,
                      const JobControl& control);
/// All files beside `path` whose names differ in the number alone. Topology is that of the first and must not change.
Animation read_obj_series(const std::filesystem::path& path);
/// Whether the name ends with a number and another file of the series is there.
bool is_obj_series(const std::filesystem::path& path);

/// BODY_0012.vtp and BODY.pvd.
void write_vtp_series(WriteTarget folder, const Animation& animation, const AnimationOptions& options,
                      const JobControl& control);
/// One body from a .pvd; its files lie in the folder of the .pvd or below.
Animation read_vtp_series(const std::filesystem::path& path);

/// BODY.obj in the first frame, and BODY.pc2 or BODY.mdd for a body that moves.
void write_pc2_files(WriteTarget folder, const Animation& animation, const AnimationOptions& options,
                     const JobControl& control);
void write_mdd_files(WriteTarget folder, const Animation& animation, const AnimationOptions& options,
                     const JobControl& control);
/// One body: the cache, and the .obj of the same name beside it.
Animation read_pc2_file(const std::filesystem::path& path);
Animation read_mdd_file(const std::filesystem::path& path);

} // namespace fascicle::io
