#pragma once
// glTF 2.0 in one binary file, read back: meshes, morph targets, and the motion of nodes.

#include "fascicle/io/animation.hpp"
#include "fascicle/io/mesh_data.hpp"

#include <string>
#include <string_view>

namespace fascicle::io {

bool looks_like_glb(std::string_view bytes);

/// A body for every node with triangles or lines (all its primitives that share positions), in metres, y up, vertices in the order of the
/// file. Frames are the times of the first animation: translation, rotation, scale and weights are read at them, linear or stepped. Files of
/// ours name their frames; others are numbered from 0. Skins, cameras, points and textures are passed over. Error naming the file and what is
/// wrong.
Animation read_glb(std::string_view bytes, const std::string& file);

/// Its first frame as one mesh, body after body.
MeshData read_glb_mesh(std::string_view bytes, const std::string& file);

} // namespace fascicle::io
