#pragma once
// A muscle's digitised outlines as areas on the bones of its scene.

#include "fascicle/anatomy/area_from_outline.hpp"
#include "fascicle/scene/scene.hpp"

#include <map>

namespace fascicle {

/// Graph and search of each bone, made when first asked for and kept as long as this lives. Not for several threads at once.
class BoneSurfaces {
public:
    /// mesh: not null.
    GeodesicSearch& search(const MeshPtr& mesh);
    const SurfaceGraph& graph(const MeshPtr& mesh) { return search(mesh).graph(); }

private:
    struct Entry {
        explicit Entry(const MeshPtr& mesh) : graph(mesh), search(graph) {}
        SurfaceGraph graph;
        GeodesicSearch search;
    };
    std::map<const TriMesh*, std::unique_ptr<Entry>> entries_; ///< the graph keeps the mesh
};

/// One area for each kind, bone and head among muscle.outlines, in their order: what its outlines enclose, one after the
/// other added, or taken out when it is a hole. Of areas that overlap on a bone the later one keeps the vertices. An outline belongs to the bone of
/// its name, else to the nearest one; one that has no bone of its name and lies on none (3 mm in the mean) is left out, with a
/// note. Error naming muscle and area for one that is far from the bone of its name (area_from_outline).
std::vector<AttachmentArea> areas_from_outlines(const Scene& scene, const Muscle& muscle,
                                                BoneSurfaces& surfaces, std::vector<std::string>& notes);

} // namespace fascicle
