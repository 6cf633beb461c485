#pragma once
// One mesh in every format, and rich files of formats that others write, for tests that are the same for all.

#include "fascicle/io/format_registry.hpp"

#include <string>
#include <utility>
#include <vector>

namespace fascicle::test {

/// Vertices in the order in which triangles use them, unused ones left out, coordinates as a float holds them: what STL keeps.
TriMesh as_stl_has_it(const TriMesh& mesh);

/// The bytes of a file of the format.
std::string written(const MeshFormat& format, const MeshData& data);

/// Name with extension and bytes: a box as every format writes it (with what it can hold), and files with everything that the
/// readers know.
std::vector<std::pair<std::string, std::string>> mesh_samples();

} // namespace fascicle::test
