#pragma once
// Files of several bodies (glTF, USD, OBJ with objects): their names, and one of them as a mesh.

#include "fascicle/io/animation.hpp"

namespace fascicle {

/// All bodies and frames of a file's bytes; no bodies for formats that hold one mesh. OBJ: its objects (`o`), in one frame. Error as of the
/// readers; for an OBJ whose objects share points there is one body.
Animation read_bodies(std::string_view bytes, const std::string& file);

/// The first frame of the body of that name; of several the first. Error (usage) naming the bodies that there are.
MeshData body_mesh(const Animation& animation, const std::string& name, const std::string& file);

/// "a, b, c and 12 more".
std::string body_names(const Animation& animation);

} // namespace fascicle
