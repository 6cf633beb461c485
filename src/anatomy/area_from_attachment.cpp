#include "fascicle/anatomy/area_from_attachment.hpp"

namespace fascicle {

SurfaceRegion area_from_attachment(const SurfaceGraph& bone, const TriMesh& muscle,
                                   const Attachment& attachment, double tolerance) {
    std::vector<int> index(muscle.positions.size(), -1);
    TriMesh patch;
    for (const int v : attachment.vertices) {
        index[static_cast<std::size_t>(v)] = static_cast<int>(patch.positions.size());
        patch.positions.push_back(muscle.positions[static_cast<std::size_t>(v)]);
    }
    for (const Tri& t : muscle.triangles) {
        const Tri moved{index[static_cast<std::size_t>(t[0])], index[static_cast<std::size_t>(t[1])],
                        index[static_cast<std::size_t>(t[2])]};
        if (moved[0] >= 0 && moved[1] >= 0 && moved[2] >= 0)
            patch.triangles.push_back(moved);
    }
    if (patch.triangles.empty())
        return SurfaceRegion(bone.vertex_count());
    return area_from_patch(bone, patch, tolerance);
}

} // namespace fascicle
