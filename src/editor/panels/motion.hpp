#pragma once
// The parts of the motion panel and what they share.

#include "editor/features.hpp"
#include "editor/panel.hpp"

namespace fascicle::editor {

void draw_hinge_way(EditorContext& context);
void draw_keys_way(EditorContext& context);
void draw_file_way(EditorContext& context);

namespace motion_rows {

/// Wrapped text.
void say(ImU32 colour, const std::string& text);
void heading(const EditorContext& context, const char* text);
/// A dim word at the left, the cursor then where the control goes, which fills the row.
void label(const EditorContext& context, const char* text);

/// What a control did in this frame.
struct Held {
    bool changed = false; ///< the value is another one: edit
    bool ended = false;   ///< let go: commit
};
/// A number to drag or type, as wide as `width` (0: the rest of the row). name: of the widget, "motion/angle".
Held number(const EditorContext& context, const char* name, double& value, float speed, const char* format,
            const std::string& tip, float width = 0);
/// Three of them beside each other, "motion/axis/x".
Held triple(const EditorContext& context, const char* name, Vec3& value, float speed, const char* format,
            const std::string& tip);
/// A button as wide as the row, or `width`.
bool button(const EditorContext& context, const char* name, const char* text, bool enabled,
            const std::string& tip, bool important = false, float width = 0);

} // namespace motion_rows

} // namespace fascicle::editor
