#pragma once
// A scene from an OpenSim model: model, trial, which mesh belongs to which body, with what they hold shown before it is opened.

#include "editor/dialogs/dialog.hpp"
#include "editor/dialogs/osim_choice.hpp"
#include "editor/widgets/file_browser.hpp"

namespace fascicle::editor {

class OsimDialog : public Dialog {
public:
    OsimDialog();
    /// With what was chosen last, if its scene has not been opened since.
    void open();
    void close() override;
    void document_replaced(); ///< what was chosen has become a scene, unless somebody is choosing again
    bool busy() const override { return choice_.reading(); }
    void draw(EditorContext& context) override;
    OsimChoice& choice() { return choice_; } ///< for tests

private:
    void draw_facts(EditorContext& context);
    void draw_rows(EditorContext& context, float height);
    void draw_body(const char* id, std::string& body, bool may_be_none, bool& guessed);
    void draw_stand_ins(EditorContext& context);
    void draw_options(EditorContext& context);

    FileBrowser browser_;
    OsimChoice choice_;
    bool appears_ = false;
    bool in_front_ = false; ///< else another dialog is closed, and the choice stays
};

} // namespace fascicle::editor
