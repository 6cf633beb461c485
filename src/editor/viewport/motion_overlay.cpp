// The hinge over the 3D picture while the motion is edited: its axis, its centre, the ball it was fitted to.
#include "editor/motion_edit.hpp"

#include "editor/features.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"

#include <cmath>
#include <cstdio>
#include <numbers>

namespace fascicle::editor {

namespace {

/// Points of the scene in pixels of the window.
class Projector {
public:
    Projector(const EditorContext& context, const Rect& area)
        : camera_(context.state.camera), area_(area), size_{double(area.width()), double(area.height())} {}

    std::optional<ImVec2> at(const Vec3& point) const {
        const std::optional<Vec2> p = camera_.project(point, size_);
        if (!p || !p->allFinite() || p->cwiseAbs().maxCoeff() > 1e5)
            return std::nullopt;
        return ImVec2{area_.min.x + static_cast<float>(p->x()), area_.min.y + static_cast<float>(p->y())};
    }
    void line(ImDrawList& list, const Vec3& a, const Vec3& b, ImU32 colour, float width) const {
        const auto p = at(a), q = at(b);
        if (p && q)
            list.AddLine(*p, *q, colour, width);
    }

private:
    const view::Camera& camera_;
    Rect area_;
    view::ViewSize size_;
};

/// Three rings at right angles, one of them around the axis.
void draw_ball(const Projector& to, ImDrawList& list, const Sphere& sphere, const Vec3& axis, ImU32 colour,
               float width) {
    const Vec3 a = axis.normalized();
    const Vec3 b = a.cross(std::abs(a.x()) < 0.9 ? Vec3::UnitX() : Vec3::UnitY()).normalized();
    const Vec3 rings[3][2] = {{b, a.cross(b)}, {a, b}, {a, a.cross(b)}};
    constexpr int pieces = 48;
    for (const auto& ring : rings)
        for (int i = 0; i < pieces; ++i) {
            const auto on = [&](int k) -> Vec3 {
                const double t = 2 * std::numbers::pi * k / pieces;
                return sphere.centre + sphere.radius * (std::cos(t) * ring[0] + std::sin(t) * ring[1]);
            };
            to.line(list, on(i), on(i + 1), colour, width);
        }
}

void cross(ImDrawList& list, ImVec2 at, float reach, ImU32 colour, float width) {
    list.AddCircle(at, reach * 0.55f, colour, 24, width);
    list.AddLine({at.x - reach, at.y}, {at.x + reach, at.y}, colour, width);
    list.AddLine({at.x, at.y - reach}, {at.x, at.y + reach}, colour, width);
}

} // namespace

bool motion_panel_shown(const EditorContext& context) {
    return context.state.layout.show_right && context.state.side_panel == "motion";
}

void draw_motion_overlay(EditorContext& context, ImDrawList& list, const Rect& area) {
    const MotionEdit& motion = context.features.motion;
    if (motion.preview() != nullptr)
        record_item("viewport/motion_preview",
                    draw_badge(list, {area.min.x + area.width() / 2, area.min.y + context.px(12)},
                               Align::centre, "Preview: muscles at rest", context.theme.text,
                               context.theme.badge));
    if (!motion_panel_shown(context) || motion.way == MotionWay::keys || !motion.hinge())
        return;
    list.PushClipRect(area.min, area.max, true);
    const Hinge& hinge = motion.hinge()->hinge;
    const Projector to(context, area);
    const ImU32 colour = context.theme.accent;
    const double reach =
        motion.ball() ? 2.2 * motion.ball()->sphere.radius : 0.12 * context.state.camera.distance();
    const Vec3 axis = hinge.axis.normalized();
    to.line(list, hinge.centre - reach * axis, hinge.centre + reach * axis, colour, context.px(2));
    if (const auto tip = to.at(hinge.centre + reach * axis)) // the end that positive angles turn about
        list.AddCircleFilled(*tip, context.px(4), colour);
    if (motion.ball())
        draw_ball(to, list, motion.ball()->sphere, axis, with_alpha(colour, 0.75f), context.px(1));
    if (const auto centre = to.at(hinge.centre)) {
        cross(list, *centre, context.px(7), colour, context.px(2));
        record_item("viewport/joint_centre", {{centre->x - context.px(7), centre->y - context.px(7)},
                                              {centre->x + context.px(7), centre->y + context.px(7)}});
        if (motion.ball()) {
            const double mm = millimetres_per_unit(context.document.scene().unit);
            char text[120];
            std::snprintf(text, sizeof text, "r %.1f mm, residual %.2f mm", motion.ball()->sphere.radius * mm,
                          motion.ball()->rms * mm);
            record_item("viewport/ball",
                        draw_badge(list, {centre->x, centre->y + context.px(16)}, Align::centre, text,
                                   context.theme.text, context.theme.badge));
        }
    }
    list.PopClipRect();
}

/// While a point is picked: what for, and the pointer as a cross.
void MotionEdit::draw(EditorContext& context, ImDrawList& list, const Rect& area) {
    const char* text = pick_ == PickFor::centre        ? "Click the joint centre on a bone"
                       : pick_ == PickFor::axis_first  ? "Click the first point of the axis on a bone"
                       : pick_ == PickFor::axis_second ? "Click the second point of the axis on a bone"
                                                       : "Click a point of the axis on a bone";
    record_item("viewport/pick",
                draw_badge(list, {area.min.x + area.width() / 2, area.max.y - context.px(40)}, Align::centre,
                           std::string(text) + "; Esc ends", context.theme.text, context.theme.badge));
    const Projector to(context, area);
    if (first_point_)
        if (const auto at = to.at(*first_point_))
            list.AddCircleFilled(*at, context.px(5), context.theme.accent);
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    if (mouse.x > area.min.x && mouse.x < area.max.x && mouse.y > area.min.y && mouse.y < area.max.y)
        cross(list, mouse, context.px(8), context.theme.accent, context.px(1));
}

} // namespace fascicle::editor
