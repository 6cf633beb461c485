#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/plot_axes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fascicle::editor {

namespace {

constexpr float click_reach = 4; ///< pixels at scale 1: less is a click, more a drag
constexpr double zoom_step = 0.8;

bool sees(const PlotAxes& axes, const PlotCurve& curve, std::size_t k, ImVec2& at) {
    const double x = curve.x.empty() ? double(k) : k < curve.x.size() ? curve.x[k] : std::nan("");
    if (k >= curve.y.size() || !std::isfinite(x) || !std::isfinite(curve.y[k]))
        return false;
    at = {axes.x(x), axes.y(curve.y[k])};
    return true;
}

/// The frame nearest to the pointer. On an axis of angles every branch has one: a drag stays on its branch, else the curve
/// nearest to the pointer decides.
double pointed_frame(const PlotAxes& axes, const PlotInput& input, ImVec2 pointer, bool dragging) {
    const double x = axes.value_x(pointer.x);
    if (input.frame_x.empty())
        return std::clamp(std::round(x), 0.0, input.last_frame);
    std::vector<std::size_t> candidates;
    std::size_t begin = 0;
    for (std::size_t branch = 0; branch <= input.frame_turns.size(); ++branch) {
        const std::size_t end =
            branch < input.frame_turns.size() ? input.frame_turns[branch] + 1 : input.frame_x.size();
        std::size_t best = begin;
        for (std::size_t k = begin; k < end && k < input.frame_x.size(); ++k)
            if (std::abs(input.frame_x[k] - x) < std::abs(input.frame_x[best] - x))
                best = k;
        candidates.push_back(best);
        begin = end > 0 ? end - 1 : 0;
    }
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t k : candidates)
        least = std::min(least, std::abs(input.frame_x[k] - x));
    const double pixel = (axes.x1 - axes.x0) / double(axes.area.width());
    std::size_t chosen = candidates[0];
    double cost = std::numeric_limits<double>::infinity();
    for (const std::size_t k : candidates) {
        if (std::abs(input.frame_x[k] - x) > least + 4 * pixel)
            continue;
        double distance = double(k) * 1e-6; // the way out, when nothing else decides
        if (dragging)
            distance = std::abs(double(k) - input.playhead);
        else
            for (const PlotCurve& curve : input.curves) {
                ImVec2 at;
                if (!curve.ghost && !curve.hidden && curve.by_frame && sees(axes, curve, k, at)) {
                    distance += double(std::abs(at.y - pointer.y));
                    break;
                }
            }
        if (distance < cost) {
            cost = distance;
            chosen = k;
        }
    }
    return double(chosen);
}

float distance_to_piece(ImVec2 p, ImVec2 a, ImVec2 b) {
    const float dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
    const float t =
        square > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / square, 0.0f, 1.0f) : 0.0f;
    return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

/// The single fibre or the ghost nearest to the pointer, within a few pixels.
void find_under(const PlotAxes& axes, const PlotInput& input, ImVec2 pointer, double frame, float scale,
                PlotResult& result) {
    const auto k = static_cast<std::size_t>(std::max(0.0, frame));
    const std::size_t from = k > 0 ? k - 1 : 0;
    float best = 6 * scale;
    for (std::size_t b = 0; b < input.bundles.size(); ++b) {
        const PlotBundle& bundle = input.bundles[b];
        for (std::size_t j = from; j + 1 < std::min(bundle.frames, k + 2); ++j) {
            const auto x = [&](std::size_t frame_of) {
                return axes.x(bundle.x.empty() ? double(frame_of) : bundle.x[frame_of]);
            };
            const float left = x(j), right = x(j + 1);
            for (std::size_t i = 0; i < bundle.count; ++i) {
                const double y0 = bundle.values[j * bundle.count + i],
                             y1 = bundle.values[(j + 1) * bundle.count + i];
                if (!std::isfinite(y0) || !std::isfinite(y1))
                    continue;
                const float d = distance_to_piece(pointer, {left, axes.y(y0)}, {right, axes.y(y1)});
                if (d < best) {
                    best = d;
                    result.hovered_bundle = static_cast<int>(b);
                    result.hovered_line = static_cast<int>(i);
                }
            }
        }
    }
    if (result.hovered_line >= 0)
        return;
    float nearest = 5 * scale;
    for (std::size_t c = 0; c < input.curves.size(); ++c) {
        const PlotCurve& curve = input.curves[c];
        for (std::size_t j = from; curve.ghost && !curve.hidden && j < k + 1; ++j) {
            ImVec2 a, b;
            if (!sees(axes, curve, j, a) || !sees(axes, curve, j + 1, b))
                continue;
            const float d = distance_to_piece(pointer, a, b);
            if (d < nearest) {
                nearest = d;
                result.hovered_curve = static_cast<int>(c);
            }
        }
    }
}

PlotRange zoomed(double low, double high, double anchor, double factor) {
    return {anchor - (anchor - low) * factor, anchor + (high - anchor) * factor};
}

/// Inside the limits, as wide as it was where that is possible.
PlotRange kept_inside(PlotRange range, const PlotInput& input) {
    const double all = input.x_limits.high - input.x_limits.low;
    const double span = std::clamp(range.high - range.low, std::min(input.least_x_span, all), all);
    const double low = std::clamp(range.low, input.x_limits.low, input.x_limits.high - span);
    return {low, low + span};
}

void begin_gesture(const char* id, PlotGesture& gesture, ImVec2 pointer) {
    const ImGuiIO& io = ImGui::GetIO();
    gesture = {};
    gesture.plot = id;
    gesture.start_x = pointer.x;
    gesture.start_y = pointer.y;
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Right))
        gesture.kind = PlotGesture::Kind::box;
    else if (ImGui::IsMouseClicked(ImGuiMouseButton_Middle) || io.KeyCtrl)
        gesture.kind = PlotGesture::Kind::pan;
    else
        gesture.kind = PlotGesture::Kind::scrub;
}

void pan(const PlotAxes& axes, const PlotInput& input, PlotGesture& gesture, float scale,
         PlotResult& result) {
    const ImGuiIO& io = ImGui::GetIO();
    const double span = axes.x1 - axes.x0;
    const double shift = -double(io.MouseDelta.x) / double(axes.area.width()) * span;
    result.x = kept_inside({axes.x0 + shift, axes.x1 + shift}, input);
    gesture.moves_y |= std::abs(io.MousePos.y - gesture.start_y) > 8 * scale;
    if (gesture.moves_y) {
        const double rise = double(io.MouseDelta.y) / double(axes.area.height()) * (axes.y1 - axes.y0);
        result.y = {{axes.y0 + rise, axes.y1 + rise}};
    }
}

void draw_box(const PlotAxes& axes, const PlotGesture& gesture, const Theme& theme, float scale) {
    const ImVec2 p = ImGui::GetIO().MousePos;
    const auto inside = [&](float x, float y) {
        return ImVec2(std::clamp(x, axes.area.min.x, axes.area.max.x),
                      std::clamp(y, axes.area.min.y, axes.area.max.y));
    };
    const ImVec2 a = inside(gesture.start_x, gesture.start_y), b = inside(p.x, p.y);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 low{std::min(a.x, b.x), std::min(a.y, b.y)}, high{std::max(a.x, b.x), std::max(a.y, b.y)};
    list.AddRectFilled(low, high, with_alpha(theme.accent, 0.18f));
    list.AddRect(low, high, theme.accent, 0, 0, scale);
}

void zoom_to_box(const PlotAxes& axes, const PlotInput& input, const PlotGesture& gesture,
                 PlotResult& result) {
    const ImVec2 p = ImGui::GetIO().MousePos;
    const auto x = [&](float px) { return axes.value_x(std::clamp(px, axes.area.min.x, axes.area.max.x)); };
    const auto y = [&](float px) { return axes.value_y(std::clamp(px, axes.area.min.y, axes.area.max.y)); };
    const float wide = std::abs(p.x - gesture.start_x), high = std::abs(p.y - gesture.start_y);
    // A box that is nearly a line zooms along it only.
    if (wide >= click_reach)
        result.x =
            kept_inside({std::min(x(gesture.start_x), x(p.x)), std::max(x(gesture.start_x), x(p.x))}, input);
    if (high >= click_reach)
        result.y = {{std::min(y(gesture.start_y), y(p.y)), std::max(y(gesture.start_y), y(p.y))}};
    if (result.y && !(result.y->high > result.y->low))
        result.y.reset();
}

} // namespace

void handle_plot_pointer(const char* id, const PlotAxes& axes, const PlotInput& input, PlotGesture& gesture,
                         const Theme& theme, float scale, PlotResult& result) {
    const ImGuiIO& io = ImGui::GetIO();
    ImGui::SetCursorScreenPos(axes.area.min);
    ImGui::InvisibleButton(id, {axes.area.width(), axes.area.height()},
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle |
                               ImGuiButtonFlags_MouseButtonRight);
    record_item(std::string(id) + "/area");
    const bool hovered = ImGui::IsItemHovered(), active = ImGui::IsItemActive();
    if (ImGui::IsItemActivated())
        begin_gesture(id, gesture, io.MousePos);
    const bool ours = gesture.kind != PlotGesture::Kind::none && gesture.plot == id;
    const bool scrubbing = ours && gesture.kind == PlotGesture::Kind::scrub;
    gesture.far |= ours && std::hypot(io.MousePos.x - gesture.start_x, io.MousePos.y - gesture.start_y) >=
                               click_reach * scale;
    if (hovered || active) {
        const double frame = pointed_frame(axes, input, io.MousePos, scrubbing && gesture.far);
        result.hovered = frame;
        if (hovered && (!ours || gesture.kind == PlotGesture::Kind::box))
            find_under(axes, input, io.MousePos, frame, scale, result);
        if (active && scrubbing)
            result.moved_to = frame;
    }
    if (ours && active && gesture.kind == PlotGesture::Kind::pan)
        pan(axes, input, gesture, scale, result);
    if (ours && gesture.kind == PlotGesture::Kind::box && gesture.far && active)
        draw_box(axes, gesture, theme, scale);
    if (ours && !active) { // released
        if (gesture.kind == PlotGesture::Kind::box && gesture.far)
            zoom_to_box(axes, input, gesture, result);
        else if (gesture.kind == PlotGesture::Kind::box)
            result.menu = true;
        gesture = {};
    }
    // Some systems turn Shift+wheel into a sideways wheel.
    const float wheel = io.MouseWheel != 0 ? io.MouseWheel : io.KeyShift ? io.MouseWheelH : 0.0f;
    if (hovered && wheel != 0) {
        const double factor = std::pow(zoom_step, double(wheel));
        if (io.KeyShift)
            result.y = zoomed(axes.y0, axes.y1, axes.value_y(io.MousePos.y), factor);
        else
            result.x = kept_inside(
                zoomed(axes.x0, axes.x1, std::clamp(axes.value_x(io.MousePos.x), axes.x0, axes.x1), factor),
                input);
    }
    if (hovered && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) && !io.KeyCtrl)
        result.fit = true;
}

} // namespace fascicle::editor
