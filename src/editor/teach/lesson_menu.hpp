#pragma once
// The menu of lessons.

#include "editor/editor_context.hpp"

namespace fascicle::editor {

void draw_lesson_menu(EditorContext& context);

} // namespace fascicle::editor
