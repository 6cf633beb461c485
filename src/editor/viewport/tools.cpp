#include "editor/viewport_tool.hpp"

namespace fascicle::editor {

ViewportTool* active_tool(EditorContext& context) {
    switch (context.state.tool) {
    case Tool::look:
    case Tool::paint:
        return nullptr;
    }
    return nullptr;
}

} // namespace fascicle::editor
