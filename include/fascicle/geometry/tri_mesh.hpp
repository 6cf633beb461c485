#pragma once
// A triangle surface as plain data. Once shared (std::shared_ptr<const TriMesh>) it never changes.

#include "fascicle/base/types.hpp"

#include <memory>

namespace fascicle {

/// positions: V points; triangles: T index triples into positions, counter-clockwise seen from outside.
/// A vertex that no triangle uses is allowed (the order of an input file is kept) and takes no part in
/// anything.
struct TriMesh {
    Points positions;
    std::vector<Tri> triangles;

    int vertex_count() const { return static_cast<int>(positions.size()); }
    int triangle_count() const { return static_cast<int>(triangles.size()); }
};

/// Open polylines over shared points (fibres): every line is a list of indices into points.
struct Polylines {
    Points points;
    std::vector<std::vector<int>> lines;
};

using MeshPtr = std::shared_ptr<const TriMesh>;

} // namespace fascicle
