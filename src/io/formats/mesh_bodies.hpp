#pragma once
// A mesh as the bodies of formats that hold scenes, in floats.

#include "fascicle/io/animation.hpp"

namespace fascicle::io {

/// Its triangles and its lines, each a body with points of its own: all points of the mesh or, when there are both, those that
/// it uses, so that what is read and written again does not grow. Empty when there are neither.
std::vector<AnimatedBody> bodies_of_mesh(const MeshData& data, BodyKind surface);

/// Error naming the file when a point that was moved or blended is not finite.
void want_finite(const Points& points, const std::string& file);

/// Error naming `where` when no float holds it.
float to_float(double value, const std::string& where);

/// As they are in a file of floats: what is made of them there, such as normals, is of what a reader sees.
Points rounded_to_floats(Points points, const std::string& where);

} // namespace fascicle::io
