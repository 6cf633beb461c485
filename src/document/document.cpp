#include "fascicle/document/document.hpp"

#include <set>

namespace fascicle {

Document::Document(Scene scene, std::filesystem::path path, HistoryLimits limits)
    : history_(std::make_shared<const Scene>(std::move(scene)), "Open", unshared_bytes, limits),
      scratch_(*history_.head()), saved_(history_.head()), path_(std::move(path)) {}

bool Document::undo() {
    if (edited_) {
        discard_edits();
        return true;
    }
    if (!history_.undo())
        return false;
    follow_head();
    return true;
}

bool Document::redo() {
    if (edited_ || !history_.redo())
        return false;
    follow_head();
    return true;
}

bool Document::jump(std::size_t step) {
    if (!history_.jump(step))
        return false;
    follow_head();
    return true;
}

void Document::mark_saved(std::filesystem::path path) {
    mark_saved(std::move(path), history_.head());
}

void Document::mark_saved(std::filesystem::path path, ScenePtr saved) {
    path_ = std::move(path);
    saved_ = std::move(saved);
}

Scene& Document::edit() {
    edited_ = true;
    ++version_;
    return scratch_;
}

bool Document::commit(std::string name) {
    if (!edited_)
        return false;
    history_.commit(std::make_shared<const Scene>(scratch_), std::move(name));
    edited_ = false;
    ++version_;
    return true;
}

void Document::discard_edits() {
    if (edited_)
        follow_head();
}

void Document::follow_head() {
    scratch_ = *history_.head();
    edited_ = false;
    ++version_;
}

namespace {

/// Heavy parts by address, with their bytes.
void collect(const Scene& scene, std::set<std::pair<const void*, std::size_t>>& parts) {
    const auto add_mesh = [&](const MeshPtr& mesh) {
        if (mesh != nullptr)
            parts.insert(
                {mesh.get(), mesh->positions.size() * sizeof(Vec3) + mesh->triangles.size() * sizeof(Tri)});
    };
    for (const Bone& bone : scene.bones)
        add_mesh(bone.mesh);
    for (const Muscle& muscle : scene.muscles) {
        add_mesh(muscle.mesh);
        if (const Polylines* fibres = muscle.surface_fibres.get(); fibres != nullptr)
            parts.insert({fibres, fibres->points.size() * (sizeof(Vec3) + sizeof(int))});
    }
}

/// Parts that every copy of the scene holds for itself.
std::size_t own_bytes(const Scene& scene) {
    std::size_t bytes =
        sizeof(Scene) + scene.bones.size() * sizeof(Bone) + scene.muscles.size() * sizeof(Muscle);
    for (const Muscle& muscle : scene.muscles) {
        for (const Attachment& attachment : muscle.attachments)
            bytes += attachment.vertices.size() * sizeof(int);
        for (const AttachmentOutline& outline : muscle.outlines)
            bytes += outline.points.size() * sizeof(Vec3);
        for (const AttachmentArea& area : muscle.areas)
            bytes += sizeof(AttachmentArea) + area.vertices.bytes();
    }
    for (const BoneTrack& track : scene.timeline.bone_tracks)
        bytes += track.keys.size() * sizeof(PoseKey);
    return bytes + scene.timeline.angles.size() * sizeof(AngleKey);
}

} // namespace

std::size_t unshared_bytes(const Scene& scene, const Scene& previous) {
    std::set<std::pair<const void*, std::size_t>> parts, shared;
    collect(scene, parts);
    collect(previous, shared);
    std::size_t bytes = own_bytes(scene);
    for (const auto& part : parts)
        bytes += shared.count(part) != 0 ? 0 : part.second;
    return bytes;
}

} // namespace fascicle
