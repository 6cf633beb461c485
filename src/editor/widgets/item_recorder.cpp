#include "editor/widgets/item_recorder.hpp"

#include "editor/control_guard.hpp"

namespace fascicle::editor {

namespace {
ItemRecorder* active = nullptr;
}

const Rect* ItemRecorder::find(std::string_view name) const {
    const auto it = items_.find(name);
    return it == items_.end() ? nullptr : &it->second;
}

void set_item_recorder(ItemRecorder* recorder) {
    active = recorder;
}

ItemRecorder* item_recorder() {
    return active;
}

void record_item(std::string_view name) {
    if (control_guard() != nullptr)
        draw_highlight(name, {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()});
    if (active != nullptr)
        active->add(name, {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()});
}

void record_item(std::string_view name, const Rect& rect) {
    draw_highlight(name, rect);
    if (active != nullptr)
        active->add(name, rect);
}

} // namespace fascicle::editor
