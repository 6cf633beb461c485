#pragma once
// What a mesh file holds, as it stands in the file: no check but that numbers are numbers and indices in
// range.

#include "fascicle/geometry/tri_mesh.hpp"

#include <string>
#include <vector>

namespace fascicle {

/// Values that go with points (or with lines): `components` numbers each, in order.
struct NamedArray {
    std::string name;
    int components = 1;
    std::vector<double> values;
};

/// mesh: polygons cut into triangle fans; points in the order of the file. lines: polylines over the same
/// points (lines.points is a copy of all points, empty when there are no lines; mesh.positions is empty when
/// the file has lines and no polygons).
struct MeshData {
    TriMesh mesh;
    Polylines lines;
    std::vector<NamedArray> point_arrays; ///< one entry per point; VTP, and of legacy VTK scalars and fields
    std::vector<NamedArray> line_arrays;  ///< one entry per line; VTP only
    std::vector<std::string> notes;       ///< what the reader passed over or assumed, a sentence each
};

} // namespace fascicle
