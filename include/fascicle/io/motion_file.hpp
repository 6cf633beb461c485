#pragma once
// Motions as tables: keyed poses of any number of bones. docs/formats.md describes the two forms.

#include "fascicle/scene/scene.hpp"

#include <filesystem>

namespace fascicle {

/// Timeline of the scene's bones from CSV with a header row, one of:
///   frame,bone,m00,m01,...,m23             3x4 transform from the rest pose, row-major
///   frame,bone,cx,cy,cz,ax,ay,az,angle_deg a turn about the axis a through c (scene units, or as a suffix of the column
///                                          says: cx_mm); rows of one frame and bone are applied in their order
/// Frames are numbers from 0, ascending for each bone; the last one of the file is the last of the timeline. A bone is at
/// rest in frame 0, and throughout when no row names it. The second form gives the timeline a hinge and its angles when
/// every bone that it names turns in the same way by one row a frame, about one axis.
/// Error (failed) naming file and line: no such bone, a number out of range, no proper rotation (to 1e-6; what is left of
/// an error within is taken out), a frame 0 that is not rest, half a turn or more between two keys where nothing says
/// which way, or in one frame.
Timeline read_motion(std::string_view bytes, const std::string& file, const Scene& scene);

} // namespace fascicle
