#pragma once
// Says what is being opened, saved or read again, while the rest of the window goes on.

#include "editor/dialogs/dialog.hpp"

namespace fascicle::editor {

class ProgressNote : public Dialog {
public:
    /// Work that is done sooner is not worth a word.
    static constexpr double patience_seconds = 0.4;
    void draw(EditorContext& context) override;

private:
    double since_ = -1; ///< when the work began; below 0: there is none
};

} // namespace fascicle::editor
