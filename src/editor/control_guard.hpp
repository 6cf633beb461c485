#pragma once
// Which controls a lesson has locked, and which it points at, by the names that widgets record (widgets/item_recorder.hpp)
// and "command/LABEL" for the rows of the command table. Any widget can ask; costs next to nothing while no lesson is on.

#include "editor/layout.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace fascicle::editor {

struct ControlGuard {
    /// Names; a trailing * stands for the rest of a name. What is highlighted is never locked.
    std::vector<std::string> locked, highlighted;
    std::string reason = "locked by the lesson";
    ImU32 ring = 0;     ///< colour of the ring round what is highlighted
    float scale = 1;    ///< of the interface
    float swelling = 0; ///< of the ring, 0 to 1; changes slowly while it pulses

    bool is_highlighted(std::string_view name) const;
    bool is_locked(std::string_view name) const;
};

/// The guard that all widgets ask; null (the default) for none. It must stay until it is replaced.
void set_control_guard(const ControlGuard* guard);
const ControlGuard* control_guard();

/// Why a control cannot be used, empty when it can.
std::string lock_reason(std::string_view name);

/// Disables the widgets drawn while it lives, when the name is locked.
class LockScope {
public:
    explicit LockScope(std::string_view name);
    ~LockScope();
    LockScope(const LockScope&) = delete;
    LockScope& operator=(const LockScope&) = delete;
    /// The tooltip with the reason behind it.
    std::string tip(const std::string& text) const;

private:
    std::string reason_;
};

/// The ring round a highlighted control; record_item() does it for every widget.
void draw_highlight(std::string_view name, const Rect& rect);

} // namespace fascicle::editor
