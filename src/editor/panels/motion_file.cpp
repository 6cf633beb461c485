// A motion from a table over time: one column as the angle of the hinge, or all joints of a model.
#include "editor/panels/motion.hpp"

#include "editor/dialogs/dialogs.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/tool_button.hpp"
#include "fascicle/io/table_motion.hpp"

#include <algorithm>
#include <cstdio>

namespace fascicle::editor {

using namespace motion_rows;

namespace {

/// Range of a column, and whether it changes at all.
std::pair<double, double> range_of(const StorageTable& table, std::size_t column) {
    double low = table.value(0, column), high = low;
    for (std::size_t r = 1; r < table.row_count(); ++r) {
        low = std::min(low, table.value(r, column));
        high = std::max(high, table.value(r, column));
    }
    return {low, high};
}

void draw_columns(EditorContext& context) {
    MotionEdit& edit = context.features.motion;
    const StorageTable& table = *edit.table;
    heading(context, "Column");
    const ImVec2 size{ImGui::GetContentRegionAvail().x, 7.5f * ImGui::GetFrameHeight()};
    ImGui::PushStyleColor(ImGuiCol_ChildBg, context.theme.plot);
    if (ImGui::BeginChild("columns", size)) {
        ImGuiListClipper clipper;
        clipper.Begin(static_cast<int>(table.columns.size()));
        while (clipper.Step())
            for (int c = clipper.DisplayStart; c < clipper.DisplayEnd; ++c) {
                const std::string& name = table.columns[static_cast<std::size_t>(c)];
                const auto [low, high] = range_of(table, static_cast<std::size_t>(c));
                ImGui::PushID(c);
                const bool time = name == "time";
                ImGui::BeginDisabled(time);
                if (ImGui::Selectable(("  " + name).c_str(), edit.column == c))
                    edit.column = c;
                record_item("motion/column/" + name);
                ImGui::EndDisabled();
                char text[60];
                std::snprintf(text, sizeof text, "%.4g to %.4g ", low, high);
                ImGui::SameLine(std::max(10.0f, size.x - ImGui::CalcTextSize(text).x - context.px(16)));
                ImGui::TextDisabled("%s", text);
                ImGui::PopID();
            }
    }
    ImGui::EndChild();
    ImGui::PopStyleColor();
}

void draw_reading(EditorContext& context) {
    MotionEdit& edit = context.features.motion;
    label(context, "Numbers are");
    if (ImGui::RadioButton("degrees", edit.degrees))
        edit.degrees = true;
    record_item("motion/degrees");
    item_tooltip(edit.table->in_degrees ? "The file says that its angles are in degrees."
                                        : "The file says nothing of degrees, so radians are meant.");
    ImGui::SameLine(0, context.px(10));
    if (ImGui::RadioButton("radians", !edit.degrees))
        edit.degrees = false;
    record_item("motion/radians");
    label(context, "Frames");
    double rate = edit.frames_per_second;
    if (number(context, "motion/rate", rate, 0.5f, "%.4g a second",
               "How many frames a second of the file becomes, 0.1 to 10000\nDefault: the scene's own rate, "
               "1 / solver.frame_time")
            .changed)
        edit.frames_per_second = std::clamp(rate, 0.1, 1e4);
    ImGui::Checkbox("The first row is rest", &edit.from_rest);
    record_item("motion/from_rest");
    item_tooltip(
        "On: values count from the first row. Off: 0 is rest, and frames lead from there to the first row.");
    if (!edit.from_rest) {
        label(context, "Lead in");
        double lead = edit.lead_in;
        if (number(context, "motion/lead_in", lead, 0.25f, "%.0f frames",
                   "Frames from rest to the first row, 1 to 10000\nDefault 20")
                .changed)
            edit.lead_in = static_cast<int>(std::clamp(std::round(lead), 1.0, 1e4));
    }
    try {
        const int frames =
            frame_count(*edit.table, {1 / edit.frames_per_second, edit.from_rest ? 0 : edit.lead_in});
        say(context.theme.text_faint, std::to_string(frames) + " frames");
    } catch (const std::exception& error) {
        say(context.theme.warning, error.what());
    }
}

void draw_hinge_from_column(EditorContext& context) {
    MotionEdit& edit = context.features.motion;
    const bool hinge = edit.hinge() && !edit.hinge()->moving.empty();
    ImGui::Checkbox("Count backwards", &edit.reversed);
    record_item("motion/reversed");
    item_tooltip("Turns the sign of the column: for a hinge whose axis points the other way.");
    if (button(context, "motion/apply_column", "Turn the hinge by this column", hinge && edit.column >= 0,
               hinge ? "The column becomes the angle of the hinge, one key a frame."
                     : "Make a hinge first: which bones turn, and about which axis.",
               true))
        edit.apply_column(context);
    if (!hinge)
        say(context.theme.text_faint, "A column turns bones about a hinge; none is set yet (Hinge).");
}

void draw_bodies(EditorContext& context) {
    MotionEdit& edit = context.features.motion;
    const Scene& scene = context.document.scene();
    heading(context, "All joints of the model");
    if (scene.line_muscles == nullptr) {
        say(context.theme.text_faint,
            "Load the line muscles of a model (.osim): its joints can then move the "
            "bones that its bodies belong to.");
        if (button(context, "motion/load_model", "Load a model...", true, "Line muscles of an OpenSim model"))
            context.dialogs.load.open(FileKind::model);
        return;
    }
    const auto& bodies = scene.line_muscles->model->skeleton.bodies;
    for (std::size_t b = 0; b < bodies.size() && b < edit.bone_of_body.size(); ++b) {
        label(context, bodies[b].name.c_str());
        ImGui::PushID(static_cast<int>(b));
        ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
        const std::string& bone = edit.bone_of_body[b];
        if (ImGui::BeginCombo("##bone", bone.empty() ? "no bone" : bone.c_str())) {
            if (ImGui::Selectable("no bone", bone.empty()))
                edit.bone_of_body[b].clear();
            record_item("motion/body/" + bodies[b].name + "/none");
            for (const Bone& other : scene.bones) {
                if (ImGui::Selectable(other.name.c_str(), other.name == bone))
                    edit.bone_of_body[b] = other.name;
                record_item("motion/body/" + bodies[b].name + "/" + other.name);
            }
            ImGui::EndCombo();
        }
        record_item("motion/body/" + bodies[b].name);
        item_tooltip("The bone that this body of the model is\nGuessed from names and places.");
        ImGui::PopID();
    }
    if (button(context, "motion/apply_model", "Move the bones by all joints", true,
               "Every coordinate that the file has moves its joint; the bones follow their bodies.", true))
        edit.apply_model(context);
}

} // namespace

void draw_file_way(EditorContext& context) {
    MotionEdit& edit = context.features.motion;
    if (context.features.loader.reading()) {
        say(context.theme.text_dim, "Reading " + context.features.loader.what() + "...");
        if (button(context, "motion/cancel_reading", "Cancel", true, "Gives up reading (Esc)."))
            context.features.loader.cancel();
        return;
    }
    if (button(context, "motion/open_table",
               edit.table == nullptr ? "Open a .mot or .sto..." : "Open another...", true,
               "A table over time, as OpenSim and SIMM write them."))
        context.dialogs.load.open(FileKind::storage);
    if (edit.table == nullptr) {
        say(context.theme.text_faint, "One column can turn the hinge, or all of them the joints of a model.");
        if (button(context, "motion/open_keys", "Open a table of poses (.csv)...", true,
                   "Keyed poses of bones, in place of the motion."))
            context.dialogs.load.open(FileKind::motion);
        return;
    }
    say(context.theme.text_dim, std::filesystem::path(edit.table->file).filename().string() + ": " +
                                    std::to_string(edit.table->row_count()) + " rows, " +
                                    std::to_string(edit.table->columns.size()) + " columns");
    draw_columns(context);
    draw_reading(context);
    draw_hinge_from_column(context);
    draw_bodies(context);
    if (!edit.table_problem.empty())
        say(context.theme.bad, edit.table_problem);
}

} // namespace fascicle::editor
