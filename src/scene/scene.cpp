#include "fascicle/scene/scene.hpp"

#include <algorithm>

namespace fascicle {

namespace {

template <typename T>
int index_of(const std::vector<T>& items, std::string_view name) {
    const auto it =
        std::find_if(items.begin(), items.end(), [&](const T& item) { return item.name == name; });
    return it == items.end() ? -1 : static_cast<int>(it - items.begin());
}

} // namespace

double millimetres_per_unit(LengthUnit unit) {
    return unit == LengthUnit::metre ? 1000.0 : 1.0;
}

const char* to_text(LengthUnit unit) {
    return unit == LengthUnit::metre ? "m" : "mm";
}

bool has_painted_areas(const Muscle& muscle) {
    return std::any_of(muscle.areas.begin(), muscle.areas.end(),
                       [](const AttachmentArea& area) { return !area.vertices.empty(); });
}

AttachmentKind attachment_end(const Scene& scene, const Attachment& attachment) {
    if (attachment.kind != AttachmentKind::unknown)
        return attachment.kind;
    return scene.timeline.moves(attachment.bone) ? AttachmentKind::insertion : AttachmentKind::origin;
}

int Scene::bone_index(std::string_view bone_name) const {
    return index_of(bones, bone_name);
}

int Scene::muscle_index(std::string_view muscle_name) const {
    return index_of(muscles, muscle_name);
}

} // namespace fascicle
