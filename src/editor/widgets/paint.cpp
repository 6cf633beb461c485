#include "editor/widgets/paint.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace fascicle::editor {

ImVec2 text_size(std::string_view text) {
    return ImGui::CalcTextSize(text.data(), text.data() + text.size());
}

void draw_text(ImDrawList& list, ImVec2 at, ImU32 colour, std::string_view text) {
    list.AddText({std::round(at.x), std::round(at.y)}, colour, text.data(), text.data() + text.size());
}

std::string elided(std::string_view text, float width) {
    if (text_size(text).x <= width)
        return std::string(text);
    static constexpr const char* dots = "\xE2\x80\xA6"; // U+2026
    std::string cut(text);
    while (!cut.empty()) {
        do { // whole UTF-8 characters
            const bool continuation = (static_cast<unsigned char>(cut.back()) & 0xC0) == 0x80;
            cut.pop_back();
            if (!continuation)
                break;
        } while (!cut.empty());
        if (text_size(cut + dots).x <= width)
            return cut + dots;
    }
    return {};
}

void draw_text_in(ImDrawList& list, const Rect& rect, ImU32 colour, std::string_view text, Align align) {
    const std::string shown = elided(text, rect.width());
    const ImVec2 size = text_size(shown);
    float x = rect.min.x;
    if (align == Align::centre)
        x += (rect.width() - size.x) * 0.5f;
    else if (align == Align::right)
        x = rect.max.x - size.x;
    draw_text(list, {x, rect.min.y + (rect.height() - size.y) * 0.5f}, colour, shown);
}

Rect draw_badge(ImDrawList& list, ImVec2 at, Align align, std::string_view text, ImU32 text_colour,
                ImU32 plate) {
    const ImVec2 size = text_size(text);
    const float pad = std::round(size.y * 0.5f);
    const float width = size.x + 2 * pad, height = size.y + pad;
    float x = at.x;
    if (align == Align::centre)
        x -= width * 0.5f;
    else if (align == Align::right)
        x -= width;
    const Rect rect{{std::round(x), at.y}, {std::round(x + width), at.y + height}};
    list.AddRectFilled(rect.min, rect.max, plate, height * 0.28f);
    draw_text(list, {rect.min.x + pad, rect.min.y + pad * 0.5f}, text_colour, text);
    return rect;
}

void draw_hatching(ImDrawList& list, const Rect& rect, ImU32 colour, float spacing, float thickness) {
    if (rect.empty() || spacing <= 0)
        return;
    list.PushClipRect(rect.min, rect.max, true);
    const float height = rect.height();
    for (float x = rect.min.x - height; x < rect.max.x; x += spacing)
        list.AddLine({x, rect.max.y}, {x + height, rect.min.y}, colour, thickness);
    list.PopClipRect();
}

std::string value_text(double value) {
    if (!std::isfinite(value))
        return "-";
    char buffer[40];
    const double size = std::abs(value);
    if (size != 0 && (size < 1e-4 || size >= 1e6))
        std::snprintf(buffer, sizeof buffer, "%.2e", value);
    else
        std::snprintf(buffer, sizeof buffer, "%.*f",
                      size >= 100  ? 1
                      : size >= 10 ? 2
                      : size >= 1  ? 3
                                   : 4,
                      value);
    return buffer;
}

} // namespace fascicle::editor
