#include "editor/viewport/recording_badge.hpp"

#include "editor/features.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"

namespace fascicle::editor {

void draw_recording_badge(EditorContext& context, ImDrawList& list, const Rect& area) {
    const output::ExportJob* job = context.features.exporter.job();
    if (job == nullptr)
        return;
    const Theme& theme = context.theme;
    const bool draws = job->drawn() < job->total();
    std::string text = output::export_kind(job->request().kind).label;
    if (job->total() > 1)
        text += "  " + std::to_string(job->drawn()) + " / " + std::to_string(job->total());
    if (!draws)
        text += ", " + job->stage();
    const std::string hint = "Esc cancels";
    const float pad = context.px(11), dot = context.px(5), gap = context.px(9), bar = context.px(4);
    const float line = ImGui::GetTextLineHeight();
    const float width = pad + 2 * dot + gap + text_size(text).x + context.px(18) + text_size(hint).x + pad;
    const ImVec2 at{area.min.x + context.px(12), area.min.y + context.px(12)};
    const Rect plate{at, {at.x + width, at.y + line + 2 * context.px(7) + bar}};
    list.AddRectFilled(plate.min, plate.max, theme.badge, context.px(6));
    const float middle = at.y + context.px(7) + line / 2;
    list.AddCircleFilled({at.x + pad + dot, middle}, dot, IM_COL32(229, 57, 53, 255));
    float x = at.x + pad + 2 * dot + gap;
    draw_text(list, {x, middle - line / 2}, theme.text, text);
    x += text_size(text).x + context.px(18);
    draw_text(list, {x, middle - line / 2}, theme.text_dim, hint);
    const Rect track{{at.x + pad, plate.max.y - context.px(3) - bar},
                     {plate.max.x - pad, plate.max.y - context.px(3)}};
    list.AddRectFilled(track.min, track.max, theme.line, bar / 2);
    const auto share = static_cast<float>(job->fraction());
    if (share > 0)
        list.AddRectFilled(track.min, {track.min.x + track.width() * share, track.max.y}, theme.accent,
                           bar / 2);
    record_item("viewport/recording", plate);
}

} // namespace fascicle::editor
