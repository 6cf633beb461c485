#pragma once
// Meshes inside of project files: JSON with the numbers as base64, read back to the last bit.

#include "fascicle/geometry/tri_mesh.hpp"
#include "io/json_fields.hpp"

namespace fascicle::io {

/// Coordinates as 32-bit floats when that loses nothing, else 64; indices with 16 bits when they fit, else 32.
Json carried_mesh_json(const TriMesh& mesh);

/// Error naming the field when sizes, text or numbers do not fit together. Nothing is allocated before the sizes have
/// been compared with the text that is there.
TriMesh read_carried_mesh(const JsonFields& entry);

} // namespace fascicle::io
