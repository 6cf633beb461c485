#pragma once
// What covers the window for a while. A new dialog is a pair of files, a member of Dialogs and a line in its list.

#include "editor/editor_context.hpp"

namespace fascicle::editor {

class Dialog {
public:
    virtual ~Dialog() = default;
    /// Once a frame, open or not.
    virtual void draw(EditorContext& context) = 0;
    /// Esc: gives up what was not confirmed.
    virtual void close() {}
    /// Whether something happens in it without any input (a file is being read): frames go on meanwhile.
    virtual bool busy() const { return false; }
};

} // namespace fascicle::editor
