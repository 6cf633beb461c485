#pragma once
// One row of the parameter table as a control: label, slider or choice, default mark, reset.

#include "editor/editor_context.hpp"

namespace fascicle::editor {

/// disabled_reason: empty when the row has an effect. Writes through document/actions/: a drag is one undo step.
void draw_param_row(EditorContext& context, const ParamRow& row, float label_width,
                    const std::string& disabled_reason);

} // namespace fascicle::editor
