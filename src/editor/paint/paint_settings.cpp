#include "editor/paint/paint_settings.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

namespace fascicle::editor {

namespace {

constexpr std::array<PaintKindRow, 7> kinds{{
    {PaintKind::brush, "brush", icons::brush, Command::paint_brush},
    {PaintKind::eraser, "eraser", icons::eraser, Command::paint_eraser},
    {PaintKind::smooth, "smooth", icons::drop, Command::paint_smooth},
    {PaintKind::smart_fill, "smart_fill", icons::wand, Command::paint_smart_fill},
    {PaintKind::bucket, "bucket", icons::filled_ring, Command::paint_bucket},
    {PaintKind::lasso, "lasso", icons::pencil, Command::paint_lasso},
    {PaintKind::line, "line", icons::line_chart, Command::paint_line},
}};

} // namespace

std::span<const PaintKindRow> paint_kinds() {
    return kinds;
}

void PaintSettings::choose(PaintKind wanted) {
    if (wanted == PaintKind::eraser && kind != PaintKind::eraser)
        before_eraser = kind;
    kind = wanted;
}

void PaintSettings::scale_radius(double factor) {
    if (pixels)
        radius_px = std::clamp(radius_px * factor, smallest_px, largest_px);
    else
        radius_mm = std::clamp(radius_mm * factor, smallest_mm, largest_mm);
}

std::string PaintSettings::radius_text() const {
    char text[32];
    if (pixels)
        std::snprintf(text, sizeof text, "%.0f px", radius_px);
    else
        std::snprintf(text, sizeof text, "%.1f mm", radius_mm);
    return text;
}

} // namespace fascicle::editor
