#pragma once
// After a crash: what is to happen to the copies that were kept.

#include "editor/dialogs/dialog.hpp"
#include "editor/widgets/picture_texture.hpp"
#include "fascicle/io/autosave.hpp"

namespace fascicle::editor {

class RecoveryDialog : public Dialog {
public:
    void ask(std::vector<AutosaveSession> sessions);
    void draw(EditorContext& context) override;

private:
    struct Row {
        AutosaveSession session;
        PictureTexture picture;
    };
    enum class Choice { none, restore, later, remove };
    Choice draw_row(EditorContext& context, Row& row, std::size_t index);
    std::vector<Row> rows_;
    bool appears_ = false;
};

/// "28 Nov 2026, 12:56", in the local time zone.
std::string time_text(std::int64_t seconds);

} // namespace fascicle::editor
