#include "simulation/resolve_attachments.hpp"

#include "fascicle/anatomy/attached_vertices.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <utility>

namespace fascicle {

namespace {

std::string length_text(double length, double unit_mm) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f mm", length * unit_mm);
    return text;
}

/// Adds vertices that no attachment has yet; merges with an attachment of the same kind and bone.
void add_vertices(std::vector<Attachment>& attachments, std::vector<char>& taken, AttachmentKind kind,
                  int bone, const std::vector<int>& vertices) {
    auto it = std::find_if(attachments.begin(), attachments.end(),
                           [&](const Attachment& a) { return a.kind == kind && a.bone == bone; });
    if (it == attachments.end())
        it = attachments.insert(attachments.end(), Attachment{kind, bone, {}});
    for (const int v : vertices)
        if (taken[static_cast<std::size_t>(v)] == 0) {
            taken[static_cast<std::size_t>(v)] = 1;
            it->vertices.push_back(v);
        }
    std::sort(it->vertices.begin(), it->vertices.end());
}

void attach_by_areas(const Scene& scene, const Muscle& muscle, const std::vector<BoneQuery>& bones,
                     std::vector<Attachment>& attachments, std::vector<char>& taken,
                     std::vector<std::string>& notes) {
    const double unit_mm = millimetres_per_unit(scene.unit);
    for (const AttachmentArea& area : muscle.areas) {
        const bool known = area.bone >= 0 && area.bone < static_cast<int>(scene.bones.size());
        const Bone* bone = known ? &scene.bones[static_cast<std::size_t>(area.bone)] : nullptr;
        const std::string what = muscle.name + ": " + area_text(area, known ? bone->name : "?");
        if (!known || area.vertices.vertex_count() != bone->mesh->vertex_count()) {
            notes.push_back(what + " is left out: it was made for another mesh");
            continue;
        }
        if (area.vertices.empty())
            continue; // not painted yet
        const auto& surface = bones[static_cast<std::size_t>(area.bone)].surface;
        std::optional<SurfaceGraph> own;
        if (!surface)
            own.emplace(bone->mesh);
        GeodesicSearch search(surface ? surface() : *own);
        const std::vector<AttachedVertex> attached =
            attached_vertices(area.vertices, search, *muscle.mesh, attach_rules(unit_mm));
        if (attached.empty())
            notes.push_back(what + " reaches no vertex of the muscle");
        add_vertices(attachments, taken, area.kind, area.bone, vertices_of(attached));
    }
}

void attach_by_nearness(const Scene& scene, const Muscle& muscle, const MeshTopology& topology,
                        const std::vector<BoneQuery>& bones, std::vector<Attachment>& attachments,
                        std::vector<char>& taken) {
    const double limit = scene.parameters.get("attachment.distance_mm") / millimetres_per_unit(scene.unit);
    const auto attach = [&](AttachmentKind kind, int bone) {
        add_vertices(attachments, taken, kind, bone,
                     attach_by_distance(*muscle.mesh, topology,
                                        bones[static_cast<std::size_t>(bone)].distance, limit));
    };
    AttachmentKind next = AttachmentKind::origin;
    for (const std::string& name :
         muscle.attach_to) // where all bones move, only their order tells which is the origin
        if (const int bone = scene.bone_index(name); bone >= 0)
            attach(std::exchange(next, AttachmentKind::insertion), bone);
    for (std::size_t b = 0; muscle.attach_to.empty() && b < bones.size(); ++b)
        attach(bones[b].moves ? AttachmentKind::insertion : AttachmentKind::origin, static_cast<int>(b));
}

} // namespace

OutlineBone find_outline_bone(const Scene& scene, const AttachmentOutline& outline,
                              const std::vector<BoneQuery>& bones) {
    std::vector<std::string> names;
    std::vector<DistanceToBone> distances;
    for (std::size_t b = 0; b < bones.size(); ++b) {
        names.push_back(scene.bones[b].name);
        distances.push_back(bones[b].distance);
    }
    const double unit_mm = millimetres_per_unit(scene.unit);
    return find_outline_bone(outline, names, distances, 3.0 / unit_mm, 1e6 / unit_mm);
}

std::vector<Attachment> resolve_attachments(const Scene& scene, const Muscle& muscle,
                                            const MeshTopology& topology, const std::vector<BoneQuery>& bones,
                                            bool nearness, std::vector<std::string>& notes) {
    if (!muscle.attachments.empty())
        return muscle.attachments;
    const double unit_mm = millimetres_per_unit(scene.unit);
    std::vector<Attachment> attachments;
    std::vector<char> taken(muscle.mesh->positions.size(), 0);
    if (has_painted_areas(muscle)) {
        attach_by_areas(scene, muscle, bones, attachments, taken, notes);
        std::erase_if(attachments, [](const Attachment& a) { return a.vertices.empty(); });
        return attachments;
    }
    for (const AttachmentOutline& outline : muscle.outlines) {
        if (outline.hole)
            continue; // an area knows holes, the rule for outlines does not
        const OutlineBone target = find_outline_bone(scene, outline, bones);
        const std::string what =
            muscle.name + ": " + to_text(outline.kind) + " outline on '" + outline.bone + "'";
        if (target.bone < 0) {
            notes.push_back(what + " is left out: the scene has no bones");
            continue;
        }
        const std::string& bone_name = scene.bones[static_cast<std::size_t>(target.bone)].name;
        if (bone_name != outline.bone)
            notes.push_back(what + " follows bone '" + bone_name + "', " +
                            length_text(target.mean_distance, unit_mm) + " away on average");
        const auto& distance = bones[static_cast<std::size_t>(target.bone)].distance;
        const std::vector<int> vertices =
            attach_by_outline(*muscle.mesh, outline.points, target.on_bone ? distance : DistanceToBone{},
                              attach_rules(unit_mm));
        if (vertices.empty())
            notes.push_back(what + " reaches no vertex of the muscle");
        add_vertices(attachments, taken, outline.kind, target.bone, vertices);
    }
    if (muscle.outlines.empty() && muscle.attach_automatically && nearness)
        attach_by_nearness(scene, muscle, topology, bones, attachments, taken);
    std::erase_if(attachments, [](const Attachment& a) { return a.vertices.empty(); });
    return attachments;
}

} // namespace fascicle
