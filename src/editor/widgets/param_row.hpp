#pragma once
// One row of the parameter table as a control: label, slider or choice, default mark, reset.

#include "editor/editor_context.hpp"

namespace fascicle::editor {

/// no_effect: why the row changes nothing now, empty when it has an effect. Writes through document/actions/: a drag is one undo step.
void draw_param_row(EditorContext& context, const ParamRow& row, float label_width,
                    const std::string& no_effect);

} // namespace fascicle::editor
