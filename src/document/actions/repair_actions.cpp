#include "fascicle/document/actions/repair_actions.hpp"

namespace fascicle::actions {

CarriedVertices replace_muscle_mesh(Document& document, int muscle, MeshPtr mesh,
                                    const std::vector<VertexOrigin>& origins) {
    FASCICLE_ASSERT(mesh != nullptr && origins.size() == mesh->positions.size());
    Scene& scene = document.edit();
    FASCICLE_ASSERT(muscle >= 0 && muscle < static_cast<int>(scene.muscles.size()));
    Muscle& m = scene.muscles[static_cast<std::size_t>(muscle)];
    CarriedVertices carried;
    for (Attachment& attachment : m.attachments) {
        carried.before += static_cast<int>(attachment.vertices.size());
        attachment.vertices = carried_members(origins, attachment.vertices);
        carried.after += static_cast<int>(attachment.vertices.size());
    }
    std::erase_if(m.attachments, [](const Attachment& a) { return a.vertices.empty(); });
    m.mesh = std::move(mesh);
    m.source.hash.clear();
    document.commit("Repair muscle " + m.name);
    return carried;
}

CarriedVertices replace_bone_mesh(Document& document, int bone, MeshPtr mesh,
                                  const std::vector<VertexOrigin>& origins) {
    FASCICLE_ASSERT(mesh != nullptr && origins.size() == mesh->positions.size());
    Scene& scene = document.edit();
    FASCICLE_ASSERT(bone >= 0 && bone < static_cast<int>(scene.bones.size()));
    Bone& b = scene.bones[static_cast<std::size_t>(bone)];
    CarriedVertices carried;
    for (Muscle& muscle : scene.muscles)
        for (AttachmentArea& area : muscle.areas) {
            if (area.bone != bone || area.vertices.vertex_count() != b.mesh->vertex_count())
                continue;
            carried.before += area.vertices.size();
            area.vertices =
                SurfaceRegion(mesh->vertex_count(), carried_members(origins, area.vertices.vertices()));
            carried.after += area.vertices.size();
        }
    b.mesh = std::move(mesh);
    b.source.hash.clear();
    document.commit("Repair bone " + b.name);
    return carried;
}

} // namespace fascicle::actions
