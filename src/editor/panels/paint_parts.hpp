#pragma once
// Parts of the paint panel.

#include "editor/editor_context.hpp"
#include "fascicle/anatomy/attachment.hpp"

namespace fascicle::editor::paint_parts {

void heading(const EditorContext& context, const std::string& title);
/// Name at the left; the next item goes to its right. Returns the width left for it.
float label(const EditorContext& context, const char* name);
void fact(const EditorContext& context, const char* name, const std::string& value, const char* tip);
void note(const EditorContext& context, const std::string& text, ImU32 colour);
/// Colour and outline of a label as on the bone.
void swatch(ImDrawList& list, const Rect& rect, AttachmentKind kind, float scale);
/// "12.34 cm²", below 1 cm² "56.7 mm²".
std::string area_text(double mm2);

/// Numbers of the area, what to do with it, all areas of the muscle, its heads.
class PaintAreas {
public:
    void draw(EditorContext& context);

private:
    void draw_numbers(EditorContext& context);
    void draw_operations(EditorContext& context);
    void draw_heads(EditorContext& context);
    void draw_list(EditorContext& context);

    std::string new_head_;
};

} // namespace fascicle::editor::paint_parts
