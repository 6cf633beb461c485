#include "editor/features.hpp"
#include "editor/viewport_tool.hpp"

namespace fascicle::editor {

ViewportTool* active_tool(EditorContext& context) {
    switch (context.state.tool) {
    case Tool::look:
    case Tool::paint:
        return nullptr;
    case Tool::pick_point:
        return &context.features.motion;
    }
    return nullptr;
}

} // namespace fascicle::editor
