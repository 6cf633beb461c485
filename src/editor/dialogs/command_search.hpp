#pragma once
// Ctrl+K: every command of the table, found by some letters of its name, run by Enter or a click.

#include "editor/dialogs/dialog.hpp"

namespace fascicle::editor {

class CommandSearch : public Dialog {
public:
    void open();
    void draw(EditorContext& context) override;
    void close() override { open_ = false; }
    bool is_open() const { return open_; }

private:
    void draw_list(EditorContext& context);

    std::string text_;
    int chosen_ = 0;     ///< row of the list
    bool is_new_ = true; ///< the list is another one, and what is meant of it not chosen yet
    bool open_ = false, appears_ = false;
    std::optional<Command> run_; ///< after the window is closed
};

/// How well a text is found in a name, for both in any case: all words of the text must begin words of the name (best),
/// or be parts of it. 0: not found.
int match_quality(std::string_view text, std::string_view name);

} // namespace fascicle::editor
