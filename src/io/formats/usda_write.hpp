#pragma once
// USD as text (.usda). Format: Pixar, "USD file format: usda", and the schemas of UsdGeom.

#include "fascicle/io/animation.hpp"
#include "fascicle/io/mesh_data.hpp"

#include <ostream>

namespace fascicle::io {

/// Positions as they are: metersPerUnit and upAxis say what they mean. The time code of a frame is its number, timeCodesPerSecond its
/// speed. Surfaces: Mesh with points, normals and extent; rigid ones inside an Xform whose translation and turn (quaternion, the shorter
/// way) have time samples. Fibres: linear BasisCurves. Names become identifiers; displayName holds them as they are. Error (from
/// `control`): Cancelled.
void write_usda(std::ostream& out, const Animation& animation, const JobControl& control = {});

/// A mesh that stands still, coordinates as they are.
void write_usda_mesh(std::ostream& out, const MeshData& data);

} // namespace fascicle::io
