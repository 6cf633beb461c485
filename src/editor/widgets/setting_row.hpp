#pragma once
// Rows of settings of the view: a label, a control in the look of the parameters, a reset where it differs from its default.

#include "editor/commands.hpp"

namespace fascicle::editor {

/// Widths of the three columns, pixels.
struct RowColumns {
    float label = 0, control = 0, reset = 0;
};
RowColumns row_columns(const EditorContext& context);

/// A heading with a line to the right border.
void section_heading(const EditorContext& context, const char* title, bool first);
/// The label and its tooltip; what follows is the control.
void row_label(const EditorContext& context, const char* label, const std::string& tip, bool edited,
               bool enabled = true);
/// The row's end. True when the reset button, which is there when `edited`, was clicked. name: "display/muscle_opacity".
bool row_reset(const EditorContext& context, const std::string& name, bool edited,
               const std::string& standard);

/// A slider that shows `text`, with a notch at `standard`. True when the value changed. Ctrl+click types the number.
bool slider_control(const EditorContext& context, const std::string& name, double& value, double low,
                    double high, double standard, const std::string& text, const std::string& tip);

/// A switch of the key table as a row: its label, a box, its key. standard: what the reset goes back to.
void switch_row(EditorContext& context, const char* name, Command command, bool standard);

} // namespace fascicle::editor
