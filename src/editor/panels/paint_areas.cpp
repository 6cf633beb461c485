#include "editor/commands.hpp"
#include "editor/features.hpp"
#include "editor/panels/paint_parts.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"
#include "editor/widgets/tool_button.hpp"
#include "fascicle/base/error.hpp"

#include <cstdio>
#include <imgui_stdlib.h>

namespace fascicle::editor::paint_parts {

using C = Command;

namespace {

template <class... Args>
std::string print(const char* format, Args... args) {
    char buffer[120];
    std::snprintf(buffer, sizeof buffer, format, args...);
    return buffer;
}

const char* shown_head(const std::string& head) {
    return head.empty() ? "(no name)" : head.c_str();
}

} // namespace

void PaintAreas::draw(EditorContext& context) {
    draw_numbers(context);
    draw_operations(context);
    draw_list(context);
    draw_heads(context);
}

void PaintAreas::draw_numbers(EditorContext& context) {
    PaintMode& paint = context.features.paint;
    heading(context, paint.settings.label == AttachmentKind::origin ? "Origin" : "Insertion");
    if (paint.preparing()) {
        note(context, "Preparing the surface of the bone...", context.theme.text_dim);
        return;
    }
    const PaintMeasure::Numbers& n = paint.measure().numbers();
    const double mm = millimetres_per_unit(context.document.scene().unit);
    const RegionMeasure& region = n.region;
    const bool none = region.vertices == 0;
    fact(context, "Area", none ? "nothing painted yet" : area_text(region.area * mm * mm),
         "Sum over its vertices of a third of the triangles around them");
    fact(context, "Centroid",
         none ? "-"
              : print("%.1f, %.1f, %.1f mm", region.centroid.x() * mm, region.centroid.y() * mm,
                      region.centroid.z() * mm),
         "Mean place, weighted by area, in scene coordinates at rest");
    fact(context, "Border",
         none ? "-" : print("%.1f mm, %d line%s", n.border * mm, n.loops, n.loops == 1 ? "" : "s"),
         "Length of the closed lines round it");
    fact(context, "Islands", none ? "-" : print("%d, holes %d", region.islands, region.holes),
         "Parts that do not hang together, and what they enclose");
    fact(context, "Vertices", std::to_string(region.vertices), "Of the bone, that carry the label");
    ImGui::Checkbox("Show what it fixes", &paint.settings.show_fixed);
    record_item("paint/show_fixed");
    item_tooltip("Dots on the vertices of the muscle that this area will hold. On by default.");
    if (paint.settings.show_fixed) {
        const auto& fixed = paint.fixed().vertices();
        const std::string count =
            paint.fixed().busy() || fixed == nullptr
                ? "counting..."
                : std::to_string(fixed->size()) + (fixed->size() == 1 ? " vertex" : " vertices");
        ImGui::SameLine();
        ImGui::PushStyleColor(ImGuiCol_Text, context.theme.text_faint);
        ImGui::TextUnformatted(count.c_str());
        ImGui::PopStyleColor();
        record_item("paint/fixed_count");
    }
}

void PaintAreas::draw_operations(EditorContext& context) {
    static constexpr std::pair<const char*, Command> buttons[] = {{"keep_largest", C::paint_keep_largest},
                                                                  {"fill_holes", C::paint_fill_holes},
                                                                  {"invert", C::paint_invert},
                                                                  {"clear", C::paint_clear},
                                                                  {"grow", C::paint_grow},
                                                                  {"shrink", C::paint_shrink}};
    const float gap = context.px(4), width = std::floor((ImGui::GetContentRegionAvail().x - gap) / 2);
    int i = 0;
    for (const auto& [id, command] : buttons) {
        const CommandState state = command_state(context, command);
        ImGui::BeginDisabled(!state.enabled);
        if (ImGui::Button(binding(command).label, {width, 0}))
            run_command(context, command);
        record_item(std::string("paint/") + id);
        ImGui::EndDisabled();
        item_tooltip(tooltip(command) + (state.enabled ? "" : "\nNot now: " + state.reason + "."));
        if (++i % 2 == 1)
            ImGui::SameLine(0, gap);
    }
}

void PaintAreas::draw_list(EditorContext& context) {
    PaintMode& paint = context.features.paint;
    const Scene& scene = context.document.scene();
    const int m = paint.muscle(context);
    if (m < 0)
        return;
    const Muscle muscle = scene.muscles[static_cast<std::size_t>(m)]; // a click may change the list
    heading(context, "Areas of " + muscle.name);
    bool origin = false, insertion = false;
    const double mm = millimetres_per_unit(scene.unit);
    const Theme& theme = context.theme;
    for (std::size_t i = 0; i < muscle.areas.size(); ++i) {
        const AttachmentArea& area = muscle.areas[i];
        if (area.vertices.empty() || area.bone < 0 || area.bone >= static_cast<int>(scene.bones.size()))
            continue;
        origin |= area.kind == AttachmentKind::origin;
        insertion |= area.kind == AttachmentKind::insertion;
        const std::string id = "paint/area/" + std::to_string(i);
        ImGui::PushID(id.c_str());
        const float height = context.px(24), side = height;
        const bool on = area.kind == paint.settings.label && area.bone == paint.bone(context) &&
                        area.head == paint.settings.head;
        if (ImGui::InvisibleButton("row",
                                   {ImGui::GetContentRegionAvail().x - side - context.px(4), height})) {
            if (area.kind != AttachmentKind::unknown)
                paint.settings.label = area.kind;
            paint.settings.head = area.head;
            if (area.bone != paint.bone(context))
                paint.set_bone(context, area.bone);
        }
        const Rect rect{ImGui::GetItemRectMin(), ImGui::GetItemRectMax()};
        record_item(id);
        ImDrawList& list = *ImGui::GetWindowDrawList();
        if (on || ImGui::IsItemHovered())
            list.AddRectFilled(rect.min, rect.max, on ? theme.accent_dim : theme.field_hovered,
                               context.px(4));
        const float half = context.px(5), middle = rect.min.y + height / 2;
        swatch(list,
               {{rect.min.x + context.px(6), middle - half}, {rect.min.x + context.px(20), middle + half}},
               area.kind, context.scale());
        const std::string size = area_text(paint.size_of(context, area) * mm * mm);
        draw_text_in(list, {rect.min, {rect.max.x - context.px(6), rect.max.y}}, theme.text_dim, size,
                     Align::right);
        draw_text_in(list,
                     {{rect.min.x + context.px(28), rect.min.y},
                      {rect.max.x - context.px(14) - text_size(size).x, rect.max.y}},
                     theme.text,
                     scene.bones[static_cast<std::size_t>(area.bone)].name +
                         (area.head.empty() ? "" : ", " + area.head));
        item_tooltip(fascicle::area_text(area, scene.bones[static_cast<std::size_t>(area.bone)].name) +
                     "\nClick to go on painting it.");
        ImGui::SameLine(0, context.px(4));
        const bool locked = area.kind != AttachmentKind::unknown && paint.settings.locked(area.kind);
        if (icon_button(context, (id + "/remove").c_str(), icons::trash, false, !locked,
                        locked ? "Remove this area\nNot now: its label is locked." : "Remove this area", 24))
            actions::set_area(context.document, {m, area.kind, area.bone, area.head},
                              SurfaceRegion(area.vertices.vertex_count()), "Remove");
        ImGui::PopID();
    }
    if (!origin && !insertion)
        note(context,
             muscle.outlines.empty() ? "None yet."
                                     : "None yet: its digitised outlines hold it until something is painted.",
             theme.text_faint);
    else if (origin != insertion)
        note(context,
             origin ? "No insertion yet: the muscle will be held at its origin alone."
                    : "No origin yet: the muscle will be held at its insertion alone.",
             theme.warning);

    BoneSurfaces* surfaces = paint.surfaces(context);
    const bool can = !muscle.outlines.empty() && surfaces != nullptr;
    ImGui::BeginDisabled(!can);
    if (ImGui::Button("From outlines", {ImGui::GetContentRegionAvail().x, 0}))
        paint.from_outlines(context);
    record_item("paint/from_outlines");
    ImGui::EndDisabled();
    item_tooltip(std::string("Makes areas of the muscle's digitised outlines, in place of those it has.") +
                 (muscle.outlines.empty() ? "\nNot now: the muscle has no outlines." : ""));
}

void PaintAreas::draw_heads(EditorContext& context) {
    PaintMode& paint = context.features.paint;
    const std::vector<std::string> heads = paint.heads(context);
    heading(context, "Heads");
    ImGui::SetNextItemWidth(label(context, "Painted head") - context.px(34));
    const bool open = ImGui::BeginCombo("##head", shown_head(paint.settings.head));
    const Rect frame{ImGui::GetItemRectMin(), ImGui::GetItemRectMax()};
    if (!open)
        item_tooltip("Head of the muscle that is painted, where it has several.");
    if (open) {
        for (const std::string& head : heads) {
            if (ImGui::Selectable(shown_head(head), head == paint.settings.head))
                paint.settings.head = head;
            record_item("paint/head/" + head);
        }
        ImGui::EndCombo();
    }
    record_item("paint/head", frame);
    ImGui::SameLine(0, context.px(4));
    const std::string current = paint.settings.head;
    if (icon_button(context, "paint/head_remove", icons::trash, false, !current.empty(),
                    current.empty() ? "Remove the head\nNot now: the muscle's only head stays."
                                    : "Remove the head '" + current + "' with its areas",
                    26))
        paint.remove_head(context, current);
    ImGui::SetNextItemWidth(label(context, "New head") - context.px(34));
    const bool entered = ImGui::InputTextWithHint("##new_head", "long, short, ...", &new_head_,
                                                  ImGuiInputTextFlags_EnterReturnsTrue);
    record_item("paint/new_head");
    item_tooltip("Name of a further head; Enter adds it.");
    ImGui::SameLine(0, context.px(4));
    const bool fresh = !new_head_.empty() && std::find(heads.begin(), heads.end(), new_head_) == heads.end();
    const bool clicked = icon_button(context, "paint/head_add", icons::plus, false, fresh,
                                     fresh ? "Add the head" : "Add the head\nNot now: type a new name.", 26);
    if ((entered || clicked) && fresh) {
        paint.add_head(context, new_head_);
        new_head_.clear();
    }
}

} // namespace fascicle::editor::paint_parts
