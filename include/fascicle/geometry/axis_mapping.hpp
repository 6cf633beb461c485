#pragma once
// Directions of the body's axes in a mesh file, taken into those of a scene. Rotations alone: nothing is mirrored.

#include "fascicle/geometry/tri_mesh.hpp"

#include <vector>

namespace fascicle {

/// LPS: +x left, +y posterior, +z superior. RAS: +x right, +y anterior, +z superior. OpenSim and ISB: X anterior, Y up, Z right.
/// y up: X left, Y up, Z anterior, as glTF and Blender's exports have it of LPS data (x to x, z to y, -y to z).
enum class AxisMapping { as_is, ras_to_lps, opensim_to_lps, lps_to_opensim, y_up_to_lps, lps_to_y_up };

struct AxisMappingRow {
    AxisMapping mapping;
    const char* key;   ///< "ras_to_lps", on the command line
    const char* label; ///< "RAS to LPS"
    const char* help;  ///< what happens to the axes
};
const std::vector<AxisMappingRow>& axis_mappings();

/// x_scene = matrix x_file. A rotation: its determinant is 1, so volumes keep their sign.
Mat3 axis_matrix(AxisMapping mapping);

/// Positions turned by the mapping and multiplied by scale > 0. Triangles stay.
TriMesh mapped(TriMesh mesh, AxisMapping mapping, double scale);

} // namespace fascicle
