#pragma once
// glTF 2.0 in one binary file (.glb). Specification: Khronos Group, "glTF 2.0", 2021 (ISO/IEC 12113:2022).

#include "fascicle/io/animation.hpp"
#include "fascicle/io/mesh_data.hpp"

#include <ostream>
#include <string>

namespace fascicle::io {

struct GltfOptions {
    int morph_targets = 64; ///< at most, 1 or more
};

/// Positions are converted to metres and y up (z up: X = x, Y = z, Z = -y, a proper rotation; a unit that is not known counts as a metre),
/// so that no node has a scale. Deforming bodies: the first frame, and a morph target with normals for each of the other frames of
/// spread_frames(), which the weights blend linearly. Rigid bodies: translation and rotation in every frame, quaternions along the shorter way.
/// Fibres are LINES. A body without triangles and lines is left out. `where` is the file, for messages. Error when it would be 4 GiB or more.
void write_glb(std::ostream& out, const Animation& animation, const GltfOptions& options,
               const std::string& where, const JobControl& control = {});

/// A mesh that stands still, coordinates as they are.
void write_glb_mesh(std::ostream& out, const MeshData& data);

} // namespace fascicle::io
