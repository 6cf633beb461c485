#pragma once
// A part of the editor that lives from frame to frame without being a panel: what is computed, read or kept beside the
// document. A new one is a pair of files, a member of Features (features.hpp) and a line in its list.

#include "editor/editor_context.hpp"

#include <optional>

namespace fascicle::editor {

class Feature {
public:
    virtual ~Feature() = default;
    /// Once a frame, after the runs are up to date and before panels draw. Never waits.
    virtual void update(EditorContext&) {}
    /// Another document was opened: forget what belonged to the old one.
    virtual void document_replaced(EditorContext&) {}
    /// Seconds until a frame without input is worth drawing; nothing: none.
    virtual std::optional<double> redraw_after() const { return std::nullopt; }
};

} // namespace fascicle::editor
