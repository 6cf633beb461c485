#pragma once
// What takes the pointer in the viewport before the camera does, and what is drawn over the 3D picture.

#include "editor/editor_context.hpp"
#include "editor/viewport_pointer.hpp"

namespace fascicle::editor {

/// One at a time: EditorState::tool. Rows in viewport/tools.cpp.
class ViewportTool {
public:
    virtual ~ViewportTool() = default;
    /// Once a frame. True: the pointer belongs to the tool, neither camera nor selection see it. A drag that the tool took
    /// keeps it until release.
    virtual bool take_pointer(EditorContext& context, const PointerInput& input,
                              const view::ViewSize& size) = 0;
    /// Cursor and preview, in pixels of the window; area: of the viewport.
    virtual void draw(EditorContext& context, ImDrawList& list, const Rect& area) = 0;
    /// Esc. True when something was given up; otherwise the tool is left.
    virtual bool cancel(EditorContext& context) = 0;
};

/// The active tool, null while looking.
ViewportTool* active_tool(EditorContext& context);

/// Drawn over the picture in the order of the table (viewport/overlays.cpp).
struct OverlayRow {
    const char* id;
    void (*draw)(EditorContext& context, ImDrawList& list, const Rect& area);
};
const std::vector<OverlayRow>& viewport_overlays();

/// The true area of a lesson's quiz, as a line, once it was scored (viewport/quiz_overlay.cpp).
void draw_quiz_truth(EditorContext& context, ImDrawList& list, const Rect& area);

} // namespace fascicle::editor
