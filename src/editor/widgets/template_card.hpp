#pragma once
// A fibre template as a picture to click: its curves in their cube, drawn as lines, so that they are sharp at any scale and in
// either theme.

#include "editor/editor_context.hpp"
#include "fascicle/anatomy/fibre_template.hpp"

namespace fascicle::editor {

class TemplateCard {
public:
    explicit TemplateCard(const FibreTemplate& fibre_template);
    /// True when clicked. name: for tests; chosen: the template in force.
    bool draw(const EditorContext& context, const std::string& name, ImVec2 size, bool chosen) const;

private:
    std::string label_, tip_;
    std::vector<std::vector<ImVec2>> curves_; ///< in the unit square, front layers last
    std::vector<float> depth_;                ///< of each curve, 0 front to 1 back
};

} // namespace fascicle::editor
