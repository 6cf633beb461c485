#pragma once
// From digitised outlines, or from nearness alone, to the muscle vertices that are fixed to bones.
// Rules and their limits: contact notes, "Attachments".

#include "fascicle/anatomy/attachment.hpp"
#include "fascicle/geometry/mesh_topology.hpp"

#include <functional>

namespace fascicle {

/// Distance of a point to a bone's surface, not negative; any value above `limit` may be returned as
/// infinity.
using DistanceToBone = std::function<double(const Vec3& p, double limit)>;

/// Lengths of the rules, all in scene units.
struct AttachRules {
    double bone = 2.5;      ///< inside of a closed outline: largest distance to the bone
    double border = 3.0;    ///< beyond a closed outline: largest distance to its border
    double open_gap = 15.0; ///< an outline whose ends are further apart is an open line
    double line = 4.0;      ///< open line: largest distance to it
    double fan = 5.0;       ///< no such bone in the scene: largest distance to the fan over the outline
};

/// AttachRules for a scene whose unit is `unit_mm` millimetres.
AttachRules attach_rules(double unit_mm);

/// Vertices that an outline fixes, ascending. A closed outline takes vertices within rules.bone of the bone
/// that project (on the outline's principal plane) into it or within rules.border of its border; an open one
/// those within rules.line of the line. Without a bone (`distance` empty): within rules.fan of the fan of
/// triangles over the outline. An outline of fewer than 3 points counts as open; an empty one takes nothing.
std::vector<int> attach_by_outline(const TriMesh& muscle, const Points& outline,
                                   const DistanceToBone& distance, const AttachRules& rules);

/// The largest patch (connected by edges, most vertices, then lowest index) of vertices within `limit` of a
/// bone.
std::vector<int> attach_by_distance(const TriMesh& muscle, const MeshTopology& topology,
                                    const DistanceToBone& distance, double limit);

} // namespace fascicle
