#pragma once
// What every way of making fibres is given, and what it gives back.

#include "fascicle/anatomy/attachment.hpp"
#include "fascicle/anatomy/fibre_carrier.hpp"
#include "fascicle/anatomy/fibre_set.hpp"
#include "fascicle/anatomy/fibre_template.hpp"
#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/geometry/tri_mesh.hpp"

#include <string>

namespace fascicle {

/// One attachment as seen on the muscle: the vertices that are fixed there, and the border it was made from.
struct AttachmentPatch {
    AttachmentKind kind = AttachmentKind::unknown; ///< origin or insertion; unknown is an error
    std::vector<int> vertices;                     ///< ascending muscle vertices, not empty
    Points outline;   ///< ordered border on the bone, closed or an open line; empty when there is none
    std::string name; ///< for messages, e.g. "origin on right_iliac"
};

/// All lengths in scene units, the muscle at rest. Borrowed pointers outlive the call.
struct FibreProblem {
    std::string muscle; ///< name, for messages
    const TriMesh* surface = nullptr;
    const MeshTopology* topology = nullptr;
    std::vector<AttachmentPatch> patches;          ///< one or more of each kind
    double unit_mm = 1.0;                          ///< millimetres in a scene unit
    int count = 100;                               ///< fibres wanted, 1 to 2000
    int segments = 15;                             ///< per fibre, 1 to 200
    const FibreTemplate* fibre_template = nullptr; ///< for methods that want one
    const Polylines* surface_fibres = nullptr; ///< superficial fibres, for methods that want them, or null
    int threads = 1;
};

/// Fibres at rest, and how they follow the surface. seconds: by stage, "field" among them when a harmonic field
/// was solved. notes: sentences for the user. field: per vertex of the surface, 0 at the origin to 1 at the
/// insertion, harmonic in between; empty when the method has none.
struct FibreModel {
    FibreSet rest;
    FibreCarrier carrier;
    std::vector<double> field;
    std::vector<std::pair<std::string, double>> seconds;
    std::vector<std::string> notes;
};

} // namespace fascicle
