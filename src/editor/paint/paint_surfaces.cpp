#include "editor/paint/paint_surfaces.hpp"

#include <chrono>

namespace fascicle::editor {

void PaintSurfaces::want(const std::vector<MeshPtr>& meshes) {
    update();
    if (busy())
        return;
    for (const MeshPtr& mesh : meshes)
        if (mesh != nullptr && built_.count(mesh) == 0)
            building_.insert(mesh);
    if (building_.empty())
        return;
    job_ = std::async(std::launch::async, [surfaces = std::move(surfaces_), missing = building_]() mutable {
        for (const MeshPtr& mesh : missing)
            surfaces.search(mesh);
        return std::move(surfaces);
    });
    job_.wait_for(std::chrono::milliseconds(40));
    update();
}

void PaintSurfaces::update() {
    if (!job_.valid() || job_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return;
    surfaces_ = job_.get();
    built_.insert(building_.begin(), building_.end());
    building_.clear();
}

BoneSurfaces* PaintSurfaces::ready(const MeshPtr& mesh) {
    return !busy() && built_.count(mesh) != 0 ? &surfaces_ : nullptr;
}

void PaintSurfaces::finish() {
    if (job_.valid())
        job_.wait();
    update();
}

void PaintSurfaces::forget() {
    finish();
    surfaces_ = BoneSurfaces();
    built_.clear();
}

} // namespace fascicle::editor
