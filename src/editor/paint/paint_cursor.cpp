// What PaintTool draws over the picture: ring, lasso, line, what is going on.

#include "editor/paint/paint_tool.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"
#include "view/attachment_marks.hpp"

namespace fascicle::editor {

namespace {

ImU32 packed(const render::Rgba& c, float alpha = 1) {
    return ImGui::ColorConvertFloat4ToU32({c[0], c[1], c[2], alpha});
}

/// A light line on a dark one: seen on any ground.
struct Pen {
    ImDrawList& list;
    ImU32 colour;
    float width;
    void line(ImVec2 a, ImVec2 b) const { list.AddLine(a, b, colour, width); }
};

} // namespace

void PaintTool::draw(EditorContext& context, ImDrawList& list, const Rect& area) {
    const auto place = [&](const Vec3& p) -> std::optional<ImVec2> {
        const std::optional<Vec2> at = view_.project(p);
        if (!at)
            return std::nullopt;
        return ImVec2{area.min.x + static_cast<float>(at->x()), area.min.y + static_cast<float>(at->y())};
    };
    const PaintSettings& settings = paint_.settings;
    const bool erasing = hover_ && mode(hover_->ctrl, hover_->shift) != actions::StrokeMode::paint;
    const ImU32 light = erasing ? IM_COL32(255, 220, 70, 255) : IM_COL32(255, 255, 255, 255);
    const ImU32 dark = IM_COL32(15, 17, 22, 170);
    const Pen pens[] = {{list, dark, context.px(3.5f)}, {list, light, context.px(1.6f)}};
    list.PushClipRect(area.min, area.max, true);
    if (hovering_)
        for (const Pen& pen : pens) {
            for (std::size_t i = 0; i + 1 < ring_.size(); i += 2) {
                const auto a = place(ring_[i]), b = place(ring_[i + 1]);
                if (a && b)
                    pen.line(*a, *b);
            }
            const ImVec2 middle{area.min.x + static_cast<float>(aim_.pointer.x()),
                                area.min.y + static_cast<float>(aim_.pointer.y())};
            const bool brush = settings.kind == PaintKind::brush || settings.kind == PaintKind::eraser ||
                               settings.kind == PaintKind::smooth;
            if (brush && settings.reach == PaintReach::screen)
                list.AddCircle(middle, static_cast<float>(aim_.radius_px), pen.colour, 64, pen.width);
            list.AddCircleFilled(middle, pen.width, pen.colour, 12);
        }
    if (hovering_)
        record_item("viewport/paint_cursor", area);
    // Lasso, closed by a thin line.
    for (const Pen& pen : pens)
        for (std::size_t i = 0; i + 1 < lasso_.size(); ++i)
            pen.line({area.min.x + float(lasso_[i].x()), area.min.y + float(lasso_[i].y())},
                     {area.min.x + float(lasso_[i + 1].x()), area.min.y + float(lasso_[i + 1].y())});
    if (lasso_.size() > 2)
        list.AddLine({area.min.x + float(lasso_.back().x()), area.min.y + float(lasso_.back().y())},
                     {area.min.x + float(lasso_.front().x()), area.min.y + float(lasso_.front().y())},
                     with_alpha(light, 0.6f), context.px(1));
    // The line: what stands, and faintly where the next piece would run.
    const ImU32 label = packed(view::attachment_colour(settings.label));
    const auto draw_line = [&](const GeodesicLine& line, float alpha) {
        for (const Pen& pen : {Pen{list, with_alpha(IM_COL32(255, 255, 255, 255), alpha), context.px(4)},
                               Pen{list, with_alpha(label, alpha), context.px(2)}})
            for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
                const auto a = place(line.points[i].point), b = place(line.points[i + 1].point);
                if (a && b)
                    pen.line(*a, *b);
            }
    };
    for (const GeodesicLine& line : lines_)
        draw_line(line, 1);
    if (hovering_)
        draw_line(next_line_, 0.55f);
    for (const SurfacePoint& anchor : anchors_)
        if (const auto at = place(anchor.point)) {
            list.AddCircleFilled(*at, context.px(5), IM_COL32(255, 255, 255, 255), 16);
            list.AddCircleFilled(*at, context.px(3.2f), label, 16);
        }
    list.PopClipRect();

    // What a press would do, at the lower edge.
    std::string text = paint_.blocked(context);
    ImU32 colour = context.theme.warning;
    if (text.empty()) {
        const Scene& scene = context.document.scene();
        const int muscle = paint_.muscle(context), bone = paint_.bone(context);
        if (muscle >= 0 && bone >= 0) {
            text = std::string(settings.label == AttachmentKind::origin ? "Origin" : "Insertion") + " of " +
                   scene.muscles[static_cast<std::size_t>(muscle)].name +
                   (settings.head.empty() ? "" : " (" + settings.head + ")") + " on " +
                   scene.bones[static_cast<std::size_t>(bone)].name;
            if (settings.kind == PaintKind::line)
                text += anchors_.empty()      ? ": click to begin a line"
                        : anchors_.size() < 3 ? ": click on; double-click ends it, Esc gives up"
                                              : ": click the first point to close it, the last to end it";
        }
        colour = context.theme.text;
    }
    if (!text.empty() && area.height() > context.px(120))
        record_item("viewport/paint_badge",
                    draw_badge(list, {area.min.x + area.width() / 2, area.max.y - context.px(38)},
                               Align::centre, elided(text, area.width() - context.px(220)), colour,
                               context.theme.badge));
    hovering_ = false; // until the pointer says so again
}

} // namespace fascicle::editor
