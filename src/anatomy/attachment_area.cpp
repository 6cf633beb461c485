#include "fascicle/anatomy/attachment_area.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/geometry/region_ops.hpp"
#include "fascicle/geometry/vertex_normals.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle {
namespace {

constexpr int highest_label = 200;

/// Names of the heads on a bone, in the order in which they appear.
std::vector<std::string> heads_on(const std::vector<AttachmentArea>& areas, int bone) {
    std::vector<std::string> heads;
    for (const AttachmentArea& area : areas)
        if (area.bone == bone && std::find(heads.begin(), heads.end(), area.head) == heads.end())
            heads.push_back(area.head);
    return heads;
}

} // namespace

std::string area_text(const AttachmentArea& area, const std::string& bone_name) {
    return std::string(to_text(area.kind)) + (area.head.empty() ? "" : " of head '" + area.head + "'") +
           " on '" + bone_name + "'";
}

int find_area(const std::vector<AttachmentArea>& areas, AttachmentKind kind, int bone,
              const std::string& head) {
    const auto it = std::find_if(areas.begin(), areas.end(), [&](const AttachmentArea& a) {
        return a.kind == kind && a.bone == bone && a.head == head;
    });
    return it == areas.end() ? -1 : static_cast<int>(it - areas.begin());
}

void give_vertices(std::vector<AttachmentArea>& areas, std::size_t keep) {
    for (std::size_t i = 0; i < areas.size(); ++i)
        if (i != keep && areas[i].bone == areas[keep].bone &&
            areas[i].vertices.vertex_count() == areas[keep].vertices.vertex_count())
            areas[i].vertices -= areas[keep].vertices;
}

std::vector<double> area_labels(const std::vector<AttachmentArea>& areas, int bone, int vertex_count) {
    std::vector<double> labels(static_cast<std::size_t>(vertex_count), 0.0);
    const std::vector<std::string> heads = heads_on(areas, bone);
    for (const AttachmentArea& area : areas) {
        if (area.bone != bone || area.vertices.vertex_count() != vertex_count)
            continue;
        const auto head = std::find(heads.begin(), heads.end(), area.head) - heads.begin();
        const double label = 2.0 * double(head) + (area.kind == AttachmentKind::insertion ? 2.0 : 1.0);
        area.vertices.for_each([&](int v) { labels[static_cast<std::size_t>(v)] = label; });
    }
    return labels;
}

std::vector<AttachmentArea> areas_from_labels(std::span<const double> labels, int bone,
                                              const std::string& where) {
    std::vector<SurfaceRegion> regions(highest_label + 1);
    for (std::size_t v = 0; v < labels.size(); ++v) {
        const double label = labels[v];
        if (!(label >= 0.0 && label <= highest_label) || label != std::floor(label))
            throw_error(where, "the label of vertex " + std::to_string(v) + " is " + std::to_string(label),
                        "0 (none), 1 (origin), 2 (insertion), 3 and 4 for a second head, up to " +
                            std::to_string(highest_label));
        if (label == 0.0)
            continue;
        SurfaceRegion& region = regions[static_cast<std::size_t>(label)];
        if (region.vertex_count() == 0)
            region = SurfaceRegion(static_cast<int>(labels.size()));
        region.insert(static_cast<int>(v));
    }
    std::vector<AttachmentArea> areas;
    for (int label = 1; label <= highest_label; ++label)
        if (SurfaceRegion& region = regions[static_cast<std::size_t>(label)]; region.vertex_count() > 0) {
            const int head = (label - 1) / 2;
            areas.push_back({label % 2 == 1 ? AttachmentKind::origin : AttachmentKind::insertion, bone,
                             head == 0 ? std::string() : std::to_string(head + 1), std::move(region)});
        }
    return areas;
}

SurfaceRegion area_from_patch(const SurfaceGraph& bone, const TriMesh& patch, double tolerance) {
    const TriangleBvh tree(patch);
    const Points normals = vertex_normals(bone.mesh().positions, bone.mesh().triangles);
    struct Side {
        SurfaceRegion region;
        double sum = 0;
        int count = 0;
    };
    Side along{SurfaceRegion(bone.vertex_count())}, against = along;
    for (int v = 0; v < bone.vertex_count(); ++v) {
        if (bone.topology().vertex_component(v) < 0)
            continue;
        const SurfacePoint foot = tree.closest(bone.position(v), tolerance * (1.0 + 1e-12));
        if (foot.triangle < 0)
            continue;
        const Tri& t = patch.triangles[static_cast<std::size_t>(foot.triangle)];
        const auto at = [&](std::size_t k) -> const Vec3& {
            return patch.positions[static_cast<std::size_t>(t[k])];
        };
        const Vec3 normal = (at(1) - at(0)).cross(at(2) - at(0));
        Side& side = normals[static_cast<std::size_t>(v)].dot(normal) >= 0.0 ? along : against;
        side.region.insert(v);
        side.sum += std::sqrt(foot.squared_distance);
        ++side.count;
    }
    if (along.count == 0 || against.count == 0)
        return along.count == 0 ? against.region : along.region;
    return along.sum / along.count <= against.sum / against.count ? along.region : against.region;
}

SurfaceRegion area_from_nearness(const SurfaceGraph& bone, const TriMesh& muscle, double limit) {
    const TriangleBvh tree(muscle);
    SurfaceRegion near(bone.vertex_count());
    for (int v = 0; v < bone.vertex_count(); ++v)
        if (bone.topology().vertex_component(v) >= 0 &&
            tree.closest(bone.position(v), limit * (1.0 + 1e-12)).triangle >= 0)
            near.insert(v);
    return keep_largest(bone, near);
}

} // namespace fascicle
