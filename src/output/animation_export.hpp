#pragma once
// A run as an animation for other programs: muscles and fibres deform, bones are rigid.

#include "fascicle/io/animation_file.hpp"
#include "output/export_kinds.hpp"

namespace fascicle::output {

/// The frames that the request names, at equal distances when `even` (the last one may then be left out). The recording must outlive it and
/// not grow; points are made when they are asked for. Error (usage) when there are no such frames.
Animation animation_of(const Recording& recording, const ExportRequest& request, bool even);

/// glb, usda, obj, pc2, mdd: the row of animation_formats() with the key request.kind.
void write_animation(const ExportRequest& request, const Recording& recording, const JobControl& control);
/// The same for one that was read from a file of another program. source: the file, which is not to be replaced.
void export_animation(const ExportRequest& request, const Animation& animation,
                      const std::filesystem::path& source, const JobControl& control);

} // namespace fascicle::output
