#pragma once
// Where a muscle is fixed on a bone, as the bone's own vertices: the area that is painted, measured and shown. The muscle
// vertices that follow from it: attached_vertices.hpp.

#include "fascicle/anatomy/attachment.hpp"
#include "fascicle/geometry/surface_graph.hpp"
#include "fascicle/geometry/surface_region.hpp"

#include <span>

namespace fascicle {

/// One head's origin or insertion on one bone; belongs to the muscle that holds it. Areas of different muscles may
/// overlap. Those of one muscle on one bone do not, since a place can be fixed for one reason only: the area that was set or
/// painted last takes the vertices from the others (give_vertices).
struct AttachmentArea {
    AttachmentKind kind = AttachmentKind::unknown;
    int bone = -1;         ///< index into Scene::bones
    std::string head = {}; ///< of a muscle with several; empty: the only one
    SurfaceRegion vertices =
        {}; ///< of the bone's mesh; another vertex count means it was made for another mesh
    friend bool operator==(const AttachmentArea&, const AttachmentArea&) = default;
};

/// "origin on 'femur'", "insertion of head 'long' on 'femur'": for messages.
std::string area_text(const AttachmentArea& area, const std::string& bone_name);

/// Index of the area with that kind, bone and head; -1 when there is none.
int find_area(const std::vector<AttachmentArea>& areas, AttachmentKind kind, int bone,
              const std::string& head = {});

/// Takes the vertices of areas[keep] from all other areas on its bone.
void give_vertices(std::vector<AttachmentArea>& areas, std::size_t keep);

/// Point array `attachment` of a bone for one muscle, as written to and read from mesh files, one value a vertex:
/// 0 none; 2 h + 1 origin, 2 h + 2 insertion of head h = 0, 1, ... (so 1 is the origin and 2 the insertion of a muscle with one
/// head). Heads count in the order in which they appear among the areas of the bone; areas without vertices appear too.
std::vector<double> area_labels(const std::vector<AttachmentArea>& areas, int bone, int vertex_count);

/// Areas from such an array, in the order of the labels. Head 0 has no name, head h the name "h + 1". Error naming `where` and
/// the vertex when a value is no label (negative, broken, not finite, above 200).
std::vector<AttachmentArea> areas_from_labels(std::span<const double> labels, int bone,
                                              const std::string& where);

/// Vertices of the bone within `tolerance` (scene units) of a patch: a surface of its own that was cut or drawn on the bone.
/// On a thin bone both sides may lie that near; of the vertices whose side faces as the patch does and of those that face
/// against it, the ones that are nearer in the mean are taken (so the patch may be inside out).
SurfaceRegion area_from_patch(const SurfaceGraph& bone, const TriMesh& patch, double tolerance);

/// Vertices of the bone within `limit` (scene units) of the muscle's surface: their largest connected part.
SurfaceRegion area_from_nearness(const SurfaceGraph& bone, const TriMesh& muscle, double limit);

} // namespace fascicle
