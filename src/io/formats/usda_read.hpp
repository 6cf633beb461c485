#pragma once
// USD as text, read back: as much as we write, and what other programs write that way.

#include "fascicle/io/animation.hpp"
#include "fascicle/io/mesh_data.hpp"

#include <string>
#include <string_view>

namespace fascicle::io {

/// Whether a number is one that lengths and times of a layer may be multiplied with or divided by.
inline bool is_usda_scale(double value) {
    return value >= 1e-9 && value <= 1e9;
}

bool looks_like_usda(std::string_view bytes);

/// Mesh (any polygons) and linear BasisCurves below Xforms with translate, orient, scale, rotate and transform; time samples between which it
/// is blended. Coordinates as they stand, in the layer's unit and with its up axis. Points that change their number are an Error, as are
/// references, variants and further layers; other prims are passed over with a note. Error naming file and line.
Animation read_usda(std::string_view bytes, const std::string& file);

/// Its first frame as one mesh, body after body.
MeshData read_usda_mesh(std::string_view bytes, const std::string& file);

} // namespace fascicle::io
