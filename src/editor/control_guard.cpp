#include "editor/control_guard.hpp"

#include "editor/theme.hpp"

#include <algorithm>

namespace fascicle::editor {

namespace {

const ControlGuard* active = nullptr;

bool matches(const std::string& pattern, std::string_view name) {
    if (!pattern.empty() && pattern.back() == '*')
        return name.starts_with(std::string_view(pattern).substr(0, pattern.size() - 1));
    return name == pattern;
}

bool any_matches(const std::vector<std::string>& patterns, std::string_view name) {
    return std::any_of(patterns.begin(), patterns.end(),
                       [&](const std::string& pattern) { return matches(pattern, name); });
}

} // namespace

bool ControlGuard::is_highlighted(std::string_view name) const {
    return any_matches(highlighted, name);
}

bool ControlGuard::is_locked(std::string_view name) const {
    if (!any_matches(locked, name))
        return false;
    // A part of a highlighted control (a choice in its list) belongs to it.
    return std::none_of(highlighted.begin(), highlighted.end(), [&](const std::string& pattern) {
        return matches(pattern, name) ||
               (name.starts_with(pattern) && name.substr(pattern.size()).starts_with("/"));
    });
}

void set_control_guard(const ControlGuard* guard) {
    active = guard;
}

const ControlGuard* control_guard() {
    return active;
}

std::string lock_reason(std::string_view name) {
    return active != nullptr && active->is_locked(name) ? active->reason : std::string();
}

LockScope::LockScope(std::string_view name) : reason_(lock_reason(name)) {
    ImGui::BeginDisabled(!reason_.empty());
}

LockScope::~LockScope() {
    ImGui::EndDisabled();
}

std::string LockScope::tip(const std::string& text) const {
    return reason_.empty() ? text : text + "\nNot now: " + reason_ + ".";
}

void draw_highlight(std::string_view name, const Rect& rect) {
    if (active == nullptr || !active->is_highlighted(name))
        return;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float grow = (2.0f + 1.5f * active->swelling) * active->scale;
    const ImVec2 min{rect.min.x - grow, rect.min.y - grow}, max{rect.max.x + grow, rect.max.y + grow};
    const float rounding = 6 * active->scale, width = 2 * active->scale;
    list.AddRectFilled(min, max, with_alpha(active->ring, 0.06f + 0.08f * active->swelling), rounding);
    list.AddRect(min, max, with_alpha(active->ring, 0.6f + 0.4f * active->swelling), rounding, 0, width);
}

} // namespace fascicle::editor
