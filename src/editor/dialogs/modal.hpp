#pragma once
// What the dialogs have in common: a window in the middle, a text that wraps, a row of buttons.

#include "editor/editor_context.hpp"

namespace fascicle::editor {

/// A modal window in the middle, width x height at scale 1 (height 0: as high as its content), never larger than the
/// screen. `appears` opens it, once no other is open, and is cleared. End with ImGui::EndPopup() when it returns true.
/// keep: with a cross in the title bar, which makes it false; null: without.
bool begin_modal(const EditorContext& context, const char* title, bool& appears, float width, float height,
                 bool* keep = nullptr);
void wrapped_text(ImU32 colour, const std::string& text);
/// Puts the next `count` buttons at the right end.
void button_row(const EditorContext& context, int count);
enum class ButtonKind { plain, primary };
/// One of the row; `why_not`: empty, or why it cannot be pressed now. True when clicked.
bool row_button(const EditorContext& context, const char* name, const char* label, const char* tip,
                ButtonKind kind = ButtonKind::plain, const std::string& why_not = {});

} // namespace fascicle::editor
