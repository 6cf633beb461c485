#include "editor/widgets/template_card.hpp"

#include "editor/control_guard.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"
#include "editor/widgets/tool_button.hpp"

#include <array>

namespace fascicle::editor {

namespace {

constexpr int layers = 3, across = 6, along = 12;

/// A point of the unit cube in the unit square, from the front and a little from above and the side; y downwards.
ImVec2 flat(const Vec3& p) {
    const double x = 0.04 + 0.74 * p.x() + 0.18 * p.z(), y = 0.04 + 0.78 * p.y() + 0.14 * p.z();
    return {static_cast<float>(x), static_cast<float>(1 - y)};
}

} // namespace

TemplateCard::TemplateCard(const FibreTemplate& fibre_template)
    : label_(fibre_template.label), tip_(fibre_template.label + "\n" + fibre_template.meaning) {
    for (int layer = layers - 1; layer >= 0; --layer)
        for (int i = 0; i < across; ++i) {
            const double r = double(layer) / (layers - 1), s = double(i) / (across - 1);
            std::vector<ImVec2>& curve = curves_.emplace_back();
            for (int j = 0; j <= along; ++j)
                curve.push_back(flat(fibre_template.point(r, s, double(j) / along)));
            depth_.push_back(static_cast<float>(r));
        }
}

bool TemplateCard::draw(const EditorContext& context, const std::string& name, ImVec2 size,
                        bool chosen) const {
    const Theme& theme = context.theme;
    ImGui::PushID(name.c_str());
    const LockScope lock(name);
    const bool clicked = ImGui::InvisibleButton("card", size);
    const Rect rect{ImGui::GetItemRectMin(), ImGui::GetItemRectMax()};
    const bool hovered = ImGui::IsItemHovered();
    record_item(name);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float rounding = context.px(6), dim = ImGui::GetStyle().Alpha;
    list.AddRectFilled(rect.min, rect.max,
                       with_alpha(chosen    ? theme.accent_dim
                                  : hovered ? theme.field_hovered
                                            : theme.field,
                                  dim),
                       rounding);
    if (chosen)
        list.AddRect(rect.min, rect.max, theme.accent, rounding, 0, context.px(2));
    const float caption = ImGui::GetTextLineHeight() + context.px(8), pad = context.px(6);
    const float side = std::min(rect.width() - 2 * pad, rect.height() - caption - pad);
    const ImVec2 origin{rect.min.x + (rect.width() - side) / 2, rect.min.y + pad};
    std::array<ImVec2, along + 1> points;
    for (std::size_t c = 0; c < curves_.size(); ++c) {
        for (std::size_t j = 0; j < points.size(); ++j)
            points[j] = {origin.x + curves_[c][j].x * side, origin.y + curves_[c][j].y * side};
        list.AddPolyline(points.data(), static_cast<int>(points.size()),
                         with_alpha(curve_colour(theme, 0), (1.0f - 0.7f * depth_[c]) * dim), 0,
                         context.px(1.4f));
    }
    draw_text_in(list, {{rect.min.x + pad, rect.max.y - caption}, {rect.max.x - pad, rect.max.y}},
                 with_alpha(chosen ? theme.text : theme.text_dim, dim), label_, Align::centre);
    item_tooltip(lock.tip(tip_));
    ImGui::PopID();
    return clicked;
}

} // namespace fascicle::editor
