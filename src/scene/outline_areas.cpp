#include "fascicle/scene/outline_areas.hpp"

#include "fascicle/anatomy/outline_bone.hpp"
#include "fascicle/base/assert.hpp"

#include <cmath>

namespace fascicle {

GeodesicSearch& BoneSurfaces::search(const MeshPtr& mesh) {
    FASCICLE_ASSERT(mesh != nullptr);
    std::unique_ptr<Entry>& entry = entries_[mesh.get()];
    if (entry == nullptr)
        entry = std::make_unique<Entry>(mesh);
    return entry->search;
}

std::vector<AttachmentArea> areas_from_outlines(const Scene& scene, const Muscle& muscle,
                                                BoneSurfaces& surfaces, std::vector<std::string>& notes) {
    const double unit_mm = millimetres_per_unit(scene.unit);
    const OutlineAreaRules rules = outline_area_rules(unit_mm);
    std::vector<std::string> names;
    std::vector<DistanceToBone> distances;
    for (const Bone& bone : scene.bones) {
        names.push_back(bone.name);
        distances.push_back([&surfaces, mesh = bone.mesh](const Vec3& p, double limit) {
            return std::sqrt(surfaces.graph(mesh).tree().closest(p, limit * (1.0 + 1e-12)).squared_distance);
        });
    }
    std::vector<AttachmentArea> areas;
    for (const AttachmentOutline& outline : muscle.outlines) {
        const OutlineBone target =
            find_outline_bone(outline, names, distances, rules.mean_far, 1e6 / unit_mm);
        AttachmentArea wanted{outline.kind, target.bone, outline.head, {}};
        const std::string who = muscle.name + ": " + area_text(wanted, outline.bone);
        if (target.bone < 0 ||
            (!target.on_bone && names[static_cast<std::size_t>(target.bone)] != outline.bone)) {
            notes.push_back(who + " is left out: no bone of the scene lies there");
            continue;
        }
        const MeshPtr& mesh = scene.bones[static_cast<std::size_t>(target.bone)].mesh;
        const SurfaceRegion region = area_from_outline(surfaces.search(mesh), outline.points, rules, who);
        int at = find_area(areas, wanted.kind, wanted.bone, wanted.head);
        if (at < 0) {
            at = static_cast<int>(areas.size());
            wanted.vertices = SurfaceRegion(mesh->vertex_count());
            areas.push_back(std::move(wanted));
        }
        if (SurfaceRegion& made = areas[static_cast<std::size_t>(at)].vertices; outline.hole)
            made -= region;
        else
            made |= region;
    }
    for (std::size_t i = 0; i < areas.size(); ++i)
        give_vertices(areas, i);
    std::erase_if(areas, [](const AttachmentArea& a) { return a.vertices.empty(); });
    return areas;
}

} // namespace fascicle
