#include "fascicle/document/actions/marker_actions.hpp"

#include <algorithm>

namespace fascicle::actions {

namespace {

bool in_range(const Scene& scene, int frame) {
    return frame >= 0 && frame <= scene.timeline.last_frame;
}

void insert_sorted(std::vector<Marker>& markers, Marker marker) {
    std::erase_if(markers, [&](const Marker& other) { return other.frame == marker.frame; });
    const auto after = std::find_if(markers.begin(), markers.end(),
                                    [&](const Marker& other) { return other.frame > marker.frame; });
    markers.insert(after, std::move(marker));
}

/// The least number that no marker's name ends the default name with.
std::string free_name(const std::vector<Marker>& markers) {
    for (int n = 1;; ++n) {
        const std::string name = "Marker " + std::to_string(n);
        if (std::none_of(markers.begin(), markers.end(), [&](const Marker& m) { return m.name == name; }))
            return name;
    }
}

} // namespace

int marker_at(const Scene& scene, int frame) {
    for (std::size_t i = 0; i < scene.markers.size(); ++i)
        if (scene.markers[i].frame == frame)
            return static_cast<int>(i);
    return -1;
}

bool add_marker(Document& document, int frame, std::string name) {
    if (!in_range(document.scene(), frame) || marker_at(document.scene(), frame) >= 0)
        return false;
    if (name.empty())
        name = free_name(document.scene().markers);
    insert_sorted(document.edit().markers, {frame, name});
    return document.commit("Add " + name);
}

bool rename_marker(Document& document, std::size_t index, std::string name) {
    const std::vector<Marker>& markers = document.scene().markers;
    if (index >= markers.size() || name.empty() || name == markers[index].name)
        return false;
    const std::string step = "Rename " + markers[index].name + " to " + name;
    document.edit().markers[index].name = std::move(name);
    return document.commit(step);
}

bool move_marker(Document& document, std::size_t index, int frame) {
    const Scene& scene = document.scene();
    if (index >= scene.markers.size() || !in_range(scene, frame) || scene.markers[index].frame == frame)
        return false;
    std::vector<Marker>& markers = document.edit().markers;
    Marker moved{frame, markers[index].name};
    const std::string step = "Move " + moved.name;
    markers.erase(markers.begin() + static_cast<std::ptrdiff_t>(index));
    insert_sorted(markers, std::move(moved));
    return document.commit(step);
}

bool remove_marker(Document& document, std::size_t index) {
    if (index >= document.scene().markers.size())
        return false;
    std::vector<Marker>& markers = document.edit().markers;
    const std::string step = "Remove " + markers[index].name;
    markers.erase(markers.begin() + static_cast<std::ptrdiff_t>(index));
    return document.commit(step);
}

} // namespace fascicle::actions
