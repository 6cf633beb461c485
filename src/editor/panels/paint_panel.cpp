#include "editor/panels/paint_parts.hpp"
#include "editor/panels/panels.hpp"

#include "editor/features.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"
#include "editor/widgets/tool_button.hpp"
#include "view/attachment_marks.hpp"

#include <cstdio>

namespace fascicle::editor {

namespace paint_parts {

void heading(const EditorContext& context, const std::string& title) {
    ImGui::Dummy({1, context.px(3)});
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, height = context.px(20);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    draw_text_in(list, {at, {at.x + width, at.y + height}}, context.theme.text_faint, title);
    const float x = at.x + text_size(title).x + context.px(8), y = std::round(at.y + height / 2);
    list.AddLine({x, y}, {at.x + width, y}, context.theme.line);
    ImGui::Dummy({width, height});
}

float label(const EditorContext& context, const char* name) {
    const float width = std::min(context.px(98), ImGui::GetContentRegionAvail().x * 0.4f);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    draw_text_in(*ImGui::GetWindowDrawList(), {at, {at.x + width, at.y + ImGui::GetFrameHeight()}},
                 context.theme.text_dim, name);
    ImGui::Dummy({width, ImGui::GetFrameHeight()});
    ImGui::SameLine(0, 0);
    return ImGui::GetContentRegionAvail().x;
}

void fact(const EditorContext& context, const char* name, const std::string& value, const char* tip) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, height = context.px(19), left = context.px(98);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    draw_text_in(list, {at, {at.x + left, at.y + height}}, context.theme.text_faint, name);
    draw_text_in(list, {{at.x + left, at.y}, {at.x + width, at.y + height}}, context.theme.text, value);
    ImGui::Dummy({width, height});
    record_item(std::string("paint/fact/") + name);
    item_tooltip(tip);
}

void note(const EditorContext& context, const std::string& text, ImU32 colour) {
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
    ImGui::Dummy({1, context.px(1)});
}

void swatch(ImDrawList& list, const Rect& rect, AttachmentKind kind, float scale) {
    const render::Rgba c = view::attachment_colour(kind);
    const ImU32 fill = ImGui::ColorConvertFloat4ToU32({c[0], c[1], c[2], 0.85f}),
                edge = ImGui::ColorConvertFloat4ToU32({c[0] * 0.55f, c[1] * 0.55f, c[2] * 0.55f, 1});
    list.AddRectFilled(rect.min, rect.max, fill, 2 * scale);
    const float width = 1.5f * scale;
    if (kind == AttachmentKind::origin) { // solid, as its border on the bone
        list.AddRect(rect.min, rect.max, edge, 2 * scale, 0, width);
        return;
    }
    const float dash = 3 * scale, gap = 2 * scale;
    for (float x = rect.min.x; x < rect.max.x; x += dash + gap)
        for (const float y : {rect.min.y, rect.max.y})
            list.AddLine({x, y}, {std::min(x + dash, rect.max.x), y}, edge, width);
    for (float y = rect.min.y; y < rect.max.y; y += dash + gap)
        for (const float x : {rect.min.x, rect.max.x})
            list.AddLine({x, y}, {x, std::min(y + dash, rect.max.y)}, edge, width);
}

std::string area_text(double mm2) {
    char text[40];
    if (mm2 >= 100)
        std::snprintf(text, sizeof text, "%.2f cm\xC2\xB2", mm2 / 100);
    else
        std::snprintf(text, sizeof text, "%.1f mm\xC2\xB2", mm2);
    return text;
}

} // namespace paint_parts

namespace {

using C = Command;
using namespace paint_parts;

class PaintPanel : public Panel {
public:
    void draw(EditorContext& context, const Rect& area) override {
        static_cast<void>(area);
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {context.px(6), context.px(5)});
        if (context.state.tool != Tool::paint || !context.features.paint.key(context))
            draw_idle(context);
        else
            draw_painting(context);
        ImGui::PopStyleVar();
    }

private:
    static void draw_idle(EditorContext& context) {
        note(context, "Draw on a bone where a muscle begins and ends: its origin and its insertion.",
             context.theme.text_dim);
        const CommandState state = command_state(context, C::paint_mode);
        ImGui::BeginDisabled(!state.enabled);
        const std::string title = "Paint on " + (state.enabled ? context.state.selection.name : "a bone");
        if (ImGui::Button(title.c_str(), {ImGui::GetContentRegionAvail().x, context.px(30)}))
            run_command(context, C::paint_mode);
        record_item("paint/enter");
        ImGui::EndDisabled();
        item_tooltip(tooltip(C::paint_mode) + (state.enabled ? "" : "\nNot now: " + state.reason + "."));
        if (!state.enabled)
            note(context, "Not now: " + state.reason + ".", context.theme.text_faint);
    }

    void draw_painting(EditorContext& context) {
        PaintMode& paint = context.features.paint;
        draw_target(context, paint);
        draw_tools(context, paint);
        draw_labels(context, paint);
        draw_settings(context, paint);
        areas_.draw(context);
        ImGui::Dummy({1, context.px(4)});
        if (ImGui::Button("Done", {ImGui::GetContentRegionAvail().x, 0}))
            run_command(context, C::paint_mode);
        record_item("paint/done");
        item_tooltip("Ends painting (" + shortcut(C::paint_mode) + " or Esc)");
    }

    /// One of the scene's names.
    template <class List>
    static int choose(const EditorContext& context, const char* id, const char* name, const List& list,
                      int now, const char* tip) {
        int chosen = now;
        ImGui::SetNextItemWidth(label(context, name));
        ImGui::PushID(id);
        const bool open = ImGui::BeginCombo("##choice", list[static_cast<std::size_t>(now)].name.c_str());
        const Rect frame{ImGui::GetItemRectMin(), ImGui::GetItemRectMax()};
        if (!open)
            item_tooltip(tip);
        if (open) {
            for (std::size_t i = 0; i < list.size(); ++i) {
                if (ImGui::Selectable(list[i].name.c_str(), static_cast<int>(i) == now))
                    chosen = static_cast<int>(i);
                record_item(std::string(id) + "/" + list[i].name);
            }
            ImGui::EndCombo();
        }
        record_item(id, frame);
        ImGui::PopID();
        return chosen;
    }

    static void draw_target(EditorContext& context, PaintMode& paint) {
        const Scene& scene = context.document.scene();
        const int muscle = choose(context, "paint/muscle", "Muscle", scene.muscles, paint.muscle(context),
                                  "Muscle whose attachment is painted.");
        if (muscle != paint.muscle(context))
            paint.set_muscle(context, muscle);
        const int bone = choose(context, "paint/bone", "Bone", scene.bones, paint.bone(context),
                                "Bone that is painted on; also by selecting it in the scene's list.");
        if (bone != paint.bone(context))
            paint.set_bone(context, bone);
        const int own = paint.muscle(context);
        if (own >= 0 && !scene.muscles[static_cast<std::size_t>(own)].attachments.empty()) {
            note(context,
                 "This muscle has attachments given vertex by vertex. They come first: what is painted does "
                 "not count.",
                 context.theme.warning);
            if (ImGui::Button("Let painted areas count", {ImGui::GetContentRegionAvail().x, 0}))
                actions::drop_fixed_attachments(context.document, own);
            record_item("paint/drop_fixed");
            item_tooltip("Drops the given attachments; can be undone.");
        }
    }

    static void draw_tools(EditorContext& context, PaintMode& paint) {
        static_cast<void>(paint);
        heading(context, "Tool");
        for (const PaintKindRow& row : paint_kinds()) {
            const std::string name = std::string("paint/tool/") + row.id;
            tool_button(context, name.c_str(), row.icon, row.command, 32);
            ImGui::SameLine(0, context.px(3));
        }
        ImGui::NewLine();
    }

    static void draw_labels(EditorContext& context, PaintMode& paint) {
        heading(context, "Label");
        for (const auto& [kind, command, name] :
             {std::tuple{AttachmentKind::origin, C::paint_origin, "origin"},
              std::tuple{AttachmentKind::insertion, C::paint_insertion, "insertion"}}) {
            ImGui::PushID(name);
            const float height = context.px(28), side = height;
            const float width = ImGui::GetContentRegionAvail().x - side - context.px(4);
            const bool on = paint.settings.label == kind;
            if (ImGui::InvisibleButton("label", {width, height}))
                run_command(context, command);
            const Rect rect{ImGui::GetItemRectMin(), ImGui::GetItemRectMax()};
            record_item(std::string("paint/label/") + name);
            ImDrawList& list = *ImGui::GetWindowDrawList();
            const Theme& theme = context.theme;
            list.AddRectFilled(rect.min, rect.max,
                               on                       ? theme.accent_dim
                               : ImGui::IsItemHovered() ? theme.field_hovered
                                                        : theme.field,
                               context.px(5));
            if (on)
                list.AddRect(rect.min, rect.max, theme.accent, context.px(5), 0, context.px(1.5f));
            const float half = context.px(7), middle = rect.min.y + height / 2;
            swatch(
                list,
                {{rect.min.x + context.px(9), middle - half}, {rect.min.x + context.px(29), middle + half}},
                kind, context.scale());
            draw_text_in(
                list, {{rect.min.x + context.px(38), rect.min.y}, {rect.max.x - context.px(30), rect.max.y}},
                on ? theme.text : theme.text_dim, binding(command).label);
            draw_text_in(list, {rect.min, {rect.max.x - context.px(10), rect.max.y}}, theme.text_faint,
                         shortcut(command), Align::right);
            item_tooltip(tooltip(command));
            ImGui::SameLine(0, context.px(4));
            bool& lock = paint.settings.lock(kind);
            const std::string lock_name = std::string("paint/lock/") + name;
            if (icon_button(context, lock_name.c_str(), lock ? icons::lock : icons::unlock, lock, true,
                            lock ? "Locked\nNo tool changes its vertices. Click to unlock."
                                 : "Lock\nKeeps its vertices from being painted over or erased.",
                            28))
                lock = !lock;
            ImGui::PopID();
        }
    }

    /// A slider with its number as text.
    static bool slider(const EditorContext& context, const char* id, double& value, double low, double high,
                       const char* format, bool logarithmic, const std::string& tip) {
        ImGui::PushID(id);
        ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
        const bool changed = ImGui::SliderScalar(
            "##slider", ImGuiDataType_Double, &value, &low, &high, format,
            ImGuiSliderFlags_AlwaysClamp | (logarithmic ? ImGuiSliderFlags_Logarithmic : 0));
        record_item(id);
        if (!ImGui::IsItemActive())
            item_tooltip(tip);
        ImGui::PopID();
        static_cast<void>(context);
        return changed;
    }

    static void draw_settings(EditorContext& context, PaintMode& paint) {
        PaintSettings& settings = paint.settings;
        heading(context, "Brush");
        label(context, "Radius");
        const std::string keys = "\nKeys " + shortcut(C::paint_smaller_radius) + " and " +
                                 shortcut(C::paint_larger_radius) + ", or Shift and the wheel.";
        if (settings.pixels)
            slider(context, "paint/radius", settings.radius_px, PaintSettings::smallest_px,
                   PaintSettings::largest_px, "%.0f px", true,
                   "Radius of the brush on the screen\nRange 4 to 400 px, default 40 px." + keys);
        else
            slider(context, "paint/radius", settings.radius_mm, PaintSettings::smallest_mm,
                   PaintSettings::largest_mm, "%.1f mm", true,
                   "Radius of the brush along the surface\nRange 0.2 to 100 mm, default 8.0 mm." + keys);
        ImGui::Dummy({std::min(context.px(98), ImGui::GetContentRegionAvail().x * 0.4f), 1});
        ImGui::SameLine(0, 0);
        ImGui::Checkbox("Same size on the screen", &settings.pixels);
        record_item("paint/pixels");
        item_tooltip("The radius is in pixels: zooming in makes the brush finer. Off by default.");

        static constexpr struct {
            PaintReach reach;
            const char *id, *name, *help;
        } reaches[] = {
            {PaintReach::connected, "connected", "Connected",
             "Along the surface from the pointer, only where it faces you and is seen: never the far "
             "side of a thin blade."},
            {PaintReach::sphere, "sphere", "Sphere", "Everything within the radius in a straight line."},
            {PaintReach::screen, "screen", "Screen", "Everything inside the circle on the screen."}};
        std::string tip = "How far the brush reaches";
        const char* now = "";
        for (const auto& row : reaches) {
            tip.append("\n").append(row.name).append(": ").append(row.help);
            if (row.reach == settings.reach)
                now = row.name;
        }
        ImGui::SetNextItemWidth(label(context, "Projection"));
        const bool open = ImGui::BeginCombo("##reach", now);
        const Rect frame{ImGui::GetItemRectMin(), ImGui::GetItemRectMax()};
        if (!open)
            item_tooltip(tip);
        if (open) {
            for (const auto& row : reaches) {
                if (ImGui::Selectable(row.name, row.reach == settings.reach))
                    settings.reach = row.reach;
                record_item(std::string("paint/reach/") + row.id);
                item_tooltip(row.help);
            }
            ImGui::EndCombo();
        }
        record_item("paint/reach", frame);

        const bool on_screen = settings.reach == PaintReach::screen || settings.kind == PaintKind::lasso;
        ImGui::Dummy({std::min(context.px(98), ImGui::GetContentRegionAvail().x * 0.4f), 1});
        ImGui::SameLine(0, 0);
        ImGui::BeginDisabled(!on_screen);
        ImGui::Checkbox("Through the bone", &settings.through);
        record_item("paint/through");
        ImGui::EndDisabled();
        item_tooltip(std::string("Also takes what the bone itself hides. Off by default.") +
                     (on_screen ? "" : "\nNot now: only for the projection Screen and the lasso."));

        label(context, "Crease angle");
        const bool creases = settings.kind == PaintKind::smart_fill;
        ImGui::BeginDisabled(!creases);
        slider(context, "paint/crease", settings.crease_deg, 1.0, 120.0, "%.0f\xC2\xB0", false,
               std::string(
                   "Smart fill stops where neighbouring faces meet at more\nRange 1 to 120\xC2\xB0, default "
                   "30\xC2\xB0.") +
                   (creases ? "" : "\nNot now: only the smart fill uses it."));
        ImGui::EndDisabled();

        const CommandState mirror = command_state(context, C::paint_mirror);
        ImGui::Dummy({std::min(context.px(98), ImGui::GetContentRegionAvail().x * 0.4f), 1});
        ImGui::SameLine(0, 0);
        ImGui::BeginDisabled(!mirror.enabled);
        bool mirrored = settings.mirror;
        if (ImGui::Checkbox("Mirror to the other side", &mirrored))
            run_command(context, C::paint_mirror);
        record_item("paint/mirror");
        ImGui::EndDisabled();
        item_tooltip(tooltip(C::paint_mirror) + (mirror.enabled ? "" : "\nNot now: " + mirror.reason + "."));
    }

    PaintAreas areas_;
};

} // namespace

std::unique_ptr<Panel> make_paint_panel() {
    return std::make_unique<PaintPanel>();
}

} // namespace fascicle::editor
