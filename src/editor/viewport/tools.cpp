#include "editor/features.hpp"
#include "editor/viewport_tool.hpp"

namespace fascicle::editor {

ViewportTool* active_tool(EditorContext& context) {
    switch (context.state.tool) {
    case Tool::look:
        return nullptr;
    case Tool::paint:
        return &context.features.paint_tool;
    case Tool::pick_point:
        return &context.features.motion;
    }
    return nullptr;
}

} // namespace fascicle::editor
