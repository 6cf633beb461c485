// Bones that turn about one axis, there and back.
#include "editor/panels/motion.hpp"

#include "editor/frame_axis.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/tool_button.hpp"

#include <algorithm>
#include <cstdio>
#include <numbers>

namespace fascicle::editor {

using namespace motion_rows;
using actions::HingeMotion;

namespace {

constexpr double degree = std::numbers::pi / 180;

template <class... Args>
std::string print(const char* format, Args... args) {
    char buffer[200];
    std::snprintf(buffer, sizeof buffer, format, args...);
    return buffer;
}

/// A first motion about the middle of the bone, along the flexion axis; the fit then finds the joint.
HingeMotion first_motion(const EditorContext& context, int bone) {
    HingeMotion motion;
    const TriMesh& mesh = *context.document.scene().bones[static_cast<std::size_t>(bone)].mesh;
    motion.hinge.centre = bounding_box(mesh.positions, mesh.triangles).center();
    motion.hinge.axis = anatomical_axes(context.state.camera.axes()).front().axis;
    motion.moving = {bone};
    return motion;
}

bool other_motion(const EditorContext& context) {
    const Scene& scene = context.document.scene();
    for (int b = 0; b < static_cast<int>(scene.bones.size()); ++b)
        if (actions::bone_moves(scene, b))
            return true;
    return false;
}

void draw_bones(EditorContext& context) {
    MotionEdit& edit = context.features.motion;
    const Scene& scene = context.document.scene();
    heading(context, "Which bones turn");
    for (int b = 0; b < static_cast<int>(scene.bones.size()); ++b) {
        const std::string name = scene.bones[static_cast<std::size_t>(b)].name;
        const bool moves =
            edit.hinge() && std::count(edit.hinge()->moving.begin(), edit.hinge()->moving.end(), b) > 0;
        bool wanted = moves;
        ImGui::PushID(b);
        if (ImGui::Checkbox(name.c_str(), &wanted)) {
            HingeMotion motion = edit.hinge() ? *edit.hinge() : first_motion(context, b);
            const bool first = !edit.hinge() || edit.hinge()->moving.empty();
            if (edit.hinge() && wanted)
                motion.moving.push_back(b);
            if (!wanted)
                std::erase(motion.moving, b);
            std::sort(motion.moving.begin(), motion.moving.end());
            const bool fit = !edit.hinge();
            edit.set(context, motion, first ? "Set motion" : "Set moving bones");
            if (fit) { // the centre is only a guess
                context.features.motion.update(context);
                edit.fit(context);
            }
        }
        ImGui::PopID();
        record_item("motion/bone/" + name);
        item_tooltip("Whether this bone turns with the joint\nThe others stay.");
    }
}

void draw_centre(EditorContext& context) {
    MotionEdit& edit = context.features.motion;
    HingeMotion motion = *edit.hinge();
    const std::string unit = to_text(context.document.scene().unit);
    const double mm = millimetres_per_unit(context.document.scene().unit);
    heading(context, ("Joint centre [" + unit + "]").c_str());
    const float speed = static_cast<float>(0.2 / mm);
    const Held held = triple(context, "motion/centre", motion.hinge.centre, speed, mm > 1 ? "%.5f" : "%.2f",
                             "Coordinate of the joint centre [" + unit + "], in the scene's axes");
    if (held.changed)
        edit.edit(context, motion);
    if (held.ended)
        edit.commit(context, "Set joint centre");
    const float half = (ImGui::GetContentRegionAvail().x - context.px(3)) / 2;
    const bool bones = !motion.moving.empty();
    if (button(context, "motion/fit", edit.fitting() ? "Fitting..." : "Fit to the bones",
               bones && !edit.fitting(),
               bones ? "Fits a sphere to the ball that the moving bone sits in the others with."
                     : "Choose a moving bone first.",
               false, half))
        edit.fit(context);
    ImGui::SameLine(0, context.px(3));
    const bool picking = edit.picking() == PickFor::centre;
    if (button(context, "motion/pick_centre", picking ? "Click on a bone..." : "Pick in the view", true,
               "The next click on a bone is the joint centre (Esc ends).", picking, half))
        edit.pick(context, picking ? PickFor::nothing : PickFor::centre);
    if (edit.ball())
        say(context.theme.text_dim,
            print("Ball of %s: radius %.1f mm, residual %.2f mm, %.0f %% of the sphere",
                  edit.ball()->bone.c_str(), edit.ball()->sphere.radius * mm, edit.ball()->rms * mm,
                  100 * edit.ball()->coverage));
    else if (!edit.fit_problem().empty())
        say(context.theme.warning,
            "No ball was found (" + edit.fit_problem() + "). Pick the centre, or type it.");
}

void draw_axis(EditorContext& context) {
    MotionEdit& edit = context.features.motion;
    HingeMotion motion = *edit.hinge();
    heading(context, "Axis");
    const std::vector<AnatomicalAxis> named = anatomical_axes(context.state.camera.axes());
    const Vec3 axis = motion.hinge.axis.normalized();
    std::string now = "Free direction";
    for (const AnatomicalAxis& row : named) {
        if ((axis - row.axis).norm() < 1e-6)
            now = row.label;
        else if ((axis + row.axis).norm() < 1e-6 && now == "Free direction")
            now = std::string(row.label) + ", negative angles";
    }
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
    const bool open = ImGui::BeginCombo("##axis", now.c_str());
    const Rect frame{ImGui::GetItemRectMin(), ImGui::GetItemRectMax()};
    if (open) {
        for (const AnatomicalAxis& row : named) {
            if (ImGui::Selectable(row.label, now == row.label)) {
                motion.hinge.axis = row.axis;
                edit.set(context, motion, "Set joint axis");
            }
            record_item(std::string("motion/axis/") + row.label);
        }
        ImGui::EndCombo();
    } else {
        item_tooltip(
            "Anatomical direction of the hip\nPositive angles go the way it says; right-hand rule about the "
            "numbers below.");
    }
    record_item("motion/axis", frame);
    const Held held =
        triple(context, "motion/axis", motion.hinge.axis, 0.01f, "%.4f", "Direction of the axis, any length");
    if (held.changed && motion.hinge.axis.norm() > 0)
        edit.edit(context, motion);
    if (held.ended)
        edit.commit(context, "Set joint axis");
    const bool picking = edit.picking() == PickFor::axis_first || edit.picking() == PickFor::axis_second;
    if (button(context, "motion/pick_axis",
               edit.picking() == PickFor::axis_second ? "Click the second point..."
               : picking                              ? "Click the first point..."
                                                      : "Pick two points in the view",
               true,
               "The axis runs through two points of bones; the centre is half way between them (Esc ends).",
               picking))
        edit.pick(context, picking ? PickFor::nothing : PickFor::axis_first);
}

void draw_course(EditorContext& context) {
    MotionEdit& edit = context.features.motion;
    HingeMotion motion = *edit.hinge();
    heading(context, "Angle and frames");
    if (!motion.there_and_back) {
        say(context.theme.text_dim,
            print("The angles come from a file or from keys: %d frames.", context.last_frame()));
        if (button(context, "motion/there_and_back", "Make it there and back", true,
                   "Replaces the angles by one turn out and back.")) {
            motion.there_and_back = true;
            motion.phases = {100, 100, 100};
            motion.angle_rad = 30 * degree;
            edit.set(context, motion, "Set motion");
        }
        return;
    }
    double angle = motion.angle_rad / degree;
    label(context, "Angle");
    Held held = number(context, "motion/angle", angle, 0.25f, "%.2f\xC2\xB0",
                       "Greatest angle [degrees], -720 to 720; positive: the way the axis says.");
    if (held.changed) {
        motion.angle_rad = std::clamp(angle, -720.0, 720.0) * degree;
        edit.edit(context, motion);
    }
    if (held.ended)
        edit.commit(context, "Set joint angle");
    const std::pair<const char*, int*> phases[] = {
        {"Out", &motion.phases.out}, {"Back", &motion.phases.back}, {"Rest", &motion.phases.rest}};
    for (const auto& [name, frames] : phases) {
        label(context, name);
        double value = *frames;
        const std::string id = std::string("motion/") + name;
        const double seconds = *frames * frame_seconds(context.document.scene());
        const std::string format = "%.0f frames" + print(" (%.3g s)", seconds);
        held = number(context, id.c_str(), value, 0.5f, format.c_str(),
                      "Frames of this part of the motion, 0 to 100000\nDefault 100");
        if (held.changed) {
            const int others = motion.phases.total() - *frames;
            *frames = static_cast<int>(std::clamp(std::round(value), others == 0 ? 1.0 : 0.0, 1e5));
            edit.edit(context, motion);
        }
        if (held.ended)
            edit.commit(context, "Set motion frames");
    }
}

} // namespace

void draw_hinge_way(EditorContext& context) {
    const MotionEdit& edit = context.features.motion;
    if (!edit.hinge() && other_motion(context)) {
        say(context.theme.text, "The motion is made of keys.");
        say(context.theme.text_faint, "Ticking a bone replaces it by a hinge; Ctrl+Z takes that back.");
    } else if (!edit.hinge()) {
        say(context.theme.text, "Nothing moves yet.");
        say(context.theme.text_faint, "Tick the bone that turns: the joint centre is then fitted to it.");
    }
    draw_bones(context);
    if (!edit.hinge())
        return;
    draw_centre(context);
    draw_axis(context);
    draw_course(context);
}

} // namespace fascicle::editor
