#pragma once
// The line of presets over the parameters: a list with what each would change, and a menu to keep the present values.

#include "editor/editor_context.hpp"

namespace fascicle::editor {

class PresetBar {
public:
    void draw(EditorContext& context);

private:
    void draw_list(EditorContext& context);
    void draw_keep(EditorContext& context);
    std::string name_;
    std::string in_force_;      ///< label of the first preset whose values hold
    std::uint64_t version_ = 0; ///< of the document that in_force_ was found for
};

} // namespace fascicle::editor
