#pragma once
// OBJ with several objects, and what our files say of unit, axes and time in comments.

#include "fascicle/io/animation.hpp"

#include <ostream>
#include <string>
#include <string_view>

namespace fascicle::io {

/// Bodies of frame k as objects, each with its own name, points and faces or lines.
void write_obj_bodies(std::ostream& out, const Animation& animation, std::size_t k);

/// Objects ("o") as bodies that stand still; points before the first object are one of their own. Frames, seconds, unit and axis from our
/// comments, where there are some. Error naming file and line, also when a face goes from one object to another.
Animation read_obj_bodies(std::string_view bytes, const std::string& file);

} // namespace fascicle::io
