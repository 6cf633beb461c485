// The right column of the mesh dialog: name, role, size, axes, and what is wrong with the surface.
#include "editor/dialogs/mesh_dialog.hpp"

#include "editor/dialogs/modal.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"
#include "editor/widgets/tool_button.hpp"
#include "fascicle/base/param_table.hpp"

#include <cstdio>
#include <imgui_stdlib.h>

namespace fascicle::editor {

namespace {

using actions::MeshRole;

template <class... Args>
std::string print(const char* format, Args... args) {
    char buffer[200];
    std::snprintf(buffer, sizeof buffer, format, args...);
    return buffer;
}

void heading(const EditorContext& context, const char* text) {
    ImGui::Dummy({1, context.px(5)});
    wrapped_text(context.theme.text_faint, text);
}

std::string triple(const Vec3& v, const char* unit) {
    return print("%.4g x %.4g x %.4g %s", v.x(), v.y(), v.z(), unit);
}

/// Mending and leftovers of a report in words for people who have never heard of manifolds.
std::vector<std::pair<bool, std::string>> findings(const MeshReport& r) {
    std::vector<std::pair<bool, std::string>> out; // serious, sentence
    const auto say = [&](int n, bool serious, const char* one, const char* many) {
        if (n > 0)
            out.emplace_back(serious, std::to_string(n) + " " + (n == 1 ? one : many));
    };
    if (r.boundary_edges > 0)
        out.emplace_back(true, print("%d %s, %d border edges in all", r.holes,
                                     r.holes == 1 ? "hole" : "holes", r.boundary_edges));
    say(r.nonmanifold_edges, true, "edge has more than two triangles", "edges have more than two triangles");
    say(r.nonmanifold_vertices, true, "vertex where surfaces only touch",
        "vertices where surfaces only touch");
    say(r.non_orientable_patches, true, "part has no inside and outside", "parts have no inside and outside");
    say(r.opposite_duplicates, true, "triangle lies back to back on another",
        "triangles lie back to back on others");
    say(r.zero_area_triangles, false, "triangle has no area", "triangles have no area");
    say(r.cavities, false, "cavity inside", "cavities inside");
    say(r.duplicate_vertices, false, "vertex lies where another is", "vertices lie where others are");
    say(r.unused_vertices, false, "vertex belongs to no triangle", "vertices belong to no triangle");
    say(r.degenerate_triangles, false, "broken triangle, left out", "broken triangles, left out");
    say(r.duplicate_triangles, false, "triangle was there twice, one left out",
        "triangles were there twice, one of each left out");
    say(r.inconsistent_triangles, false, "triangle faced the wrong way, turned round",
        "triangles faced the wrong way, turned round");
    say(r.inverted_components, false, "part was inside out, turned round",
        "parts were inside out, turned round");
    return out;
}

} // namespace

void MeshDialog::draw_details(EditorContext& context) {
    const Theme& theme = context.theme;
    if (selected_ < 0) {
        wrapped_text(theme.text_dim, "Choose meshes of bones and muscles.");
        wrapped_text(theme.text_faint,
                     "A click on a file puts it into the list. Files can also be dropped on the "
                     "window, many at once.");
        return;
    }
    const MeshEntry entry = batch_.entries()[static_cast<std::size_t>(selected_)];
    if (!entry.problem.empty()) {
        wrapped_text(theme.text, entry.path.filename().string());
        wrapped_text(theme.bad, entry.problem);
        return;
    }
    if (entry.read == nullptr) {
        wrapped_text(theme.text, entry.path.filename().string());
        wrapped_text(theme.text_faint, "Reading...");
        return;
    }
    std::string name = entry.name;
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
    if (ImGui::InputText("##name", &name) && !name.empty())
        batch_.change(selected_, [&](MeshEntry& e) { e.name = name; });
    record_item("mesh/name");
    item_tooltip("Name in the scene\nDefault: the file's name. One that is taken gets a number behind it.");
    const MeshReport& report = entry.surface().report;
    wrapped_text(theme.text_faint, print("%s, %d vertices, %d triangles", entry.read->file.format.c_str(),
                                         report.vertices, report.triangles));
    draw_role(context, entry);
    draw_size(context, entry);
    draw_axes(context, entry);
    if (batch_.ready_count() > 1) {
        ImGui::Dummy({1, context.px(2)});
        if (ImGui::Button(print("Use for all %d", batch_.ready_count()).c_str())) {
            batch_.use_for_all(selected_);
            preview_.frame();
        }
        record_item("mesh/for_all");
        item_tooltip("Gives unit and axes of this mesh to all in the list.");
    }
    draw_findings(context, entry);
}

void MeshDialog::draw_role(EditorContext& context, const MeshEntry& entry) {
    ImGui::Dummy({1, context.px(3)});
    const auto choose = [&](MeshRole role) {
        batch_.change(selected_, [&](MeshEntry& e) { e.role = role; });
    };
    if (ImGui::RadioButton("Muscle", entry.role == MeshRole::muscle))
        choose(MeshRole::muscle);
    record_item("mesh/muscle");
    item_tooltip("It will be deformed. Needs a closed surface.");
    ImGui::SameLine(0, context.px(18));
    if (ImGui::RadioButton("Bone", entry.role == MeshRole::bone))
        choose(MeshRole::bone);
    record_item("mesh/bone");
    item_tooltip("Rigid; muscles attach to it and cannot enter it.");
    if (entry.role == MeshRole::bone && context.document.scene().timeline.hinge) {
        bool moving = entry.moving;
        if (ImGui::Checkbox("Turns with the joint", &moving))
            batch_.change(selected_, [&](MeshEntry& e) { e.moving = moving; });
        record_item("mesh/moving");
        item_tooltip("The bone takes part in the motion of the scene.");
    }
}

void MeshDialog::draw_size(EditorContext& context, const MeshEntry& entry) {
    const Scene& scene = context.document.scene();
    const double mm = entry.scale * millimetres_per_unit(scene.unit);
    heading(context, "Size");
    wrapped_text(context.theme.text, triple(mm * entry.surface().box.size(), "mm"));
    if (entry.surface().report.closed())
        wrapped_text(context.theme.text_dim,
                     print("%.4g cm\xC2\xB3 enclosed", entry.surface().volume * std::pow(mm / 10, 3)));
    const float width = std::min(context.px(74), (ImGui::GetContentRegionAvail().x - 2 * context.px(6)) / 3);
    for (const double factor : {0.001, 1.0, 1000.0}) {
        if (factor != 0.001)
            ImGui::SameLine(0, context.px(6));
        const bool on = entry.scale == factor;
        if (on)
            ImGui::PushStyleColor(ImGuiCol_Button, context.theme.accent_dim);
        const std::string label = "x " + number_text(factor);
        if (ImGui::Button(label.c_str(), {width, 0})) {
            batch_.change(selected_, [&](MeshEntry& e) {
                e.scale = factor;
                e.scale_guessed = false;
            });
            preview_.frame();
        }
        if (on)
            ImGui::PopStyleColor();
        record_item("mesh/scale/" + number_text(factor));
        item_tooltip("Multiplies the coordinates. The scene is in " + std::string(to_text(scene.unit)) +
                     ".\nGuess: a diagonal below 5 is taken for metres, up to 5000 for millimetres.");
    }
    const std::string why =
        entry.read->hints.millimetres
            ? "The file says that a unit is " + number_text(*entry.read->hints.millimetres) + " mm."
            : "Guessed from the size.";
    if (entry.scale_guessed)
        wrapped_text(context.theme.warning,
                     "Coordinates times " + number_text(entry.scale) + ". " + why + " Please check.");
    else if (const auto unit = actions::guess_unit(*entry.read->surface.mesh); !unit)
        wrapped_text(context.theme.warning, "Unusually large: please check the unit.");
}

void MeshDialog::draw_axes(EditorContext& context, const MeshEntry& entry) {
    heading(context, "Axes");
    const auto& rows = axis_mappings();
    const auto now = std::find_if(rows.begin(), rows.end(),
                                  [&](const AxisMappingRow& row) { return row.mapping == entry.axes; });
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
    if (ImGui::BeginCombo("##axes", now->label)) {
        for (const AxisMappingRow& row : rows) {
            if (ImGui::Selectable(row.label, row.mapping == entry.axes)) {
                batch_.change(selected_, [&](MeshEntry& e) {
                    e.axes = row.mapping;
                    e.axes_guessed = false;
                });
                preview_.frame();
            }
            record_item(std::string("mesh/axes/") + row.label);
            item_tooltip(row.help);
        }
        ImGui::EndCombo();
    }
    record_item("mesh/axes");
    item_tooltip(std::string(now->help) + "\nAll of these turn the mesh; none mirrors it.");
    if (entry.axes_guessed)
        wrapped_text(context.theme.warning, "The file says SPACE=RAS. Please check.");
    else
        wrapped_text(context.theme.text_faint, now->help);
}

void MeshDialog::draw_findings(EditorContext& context, const MeshEntry& entry) {
    const Theme& theme = context.theme;
    const MeshReport& report = entry.surface().report;
    heading(context, "Surface");
    wrapped_text(report.closed() ? theme.good : theme.warning,
                 report.closed() ? "Closed: it encloses a volume" : "Open: it encloses no volume");
    const std::string obstacle = entry.obstacle();
    if (!obstacle.empty())
        wrapped_text(theme.bad, std::string("Cannot be a ") +
                                    (entry.role == MeshRole::bone ? "bone: it " : "muscle: it ") + obstacle +
                                    ".");
    if (entry.read->filled) {
        bool fill = entry.fill;
        const HoleFilling& filling = entry.read->filling;
        const std::string label =
            filling.filled == 1 ? "Fill the hole" : print("Fill %d holes", filling.filled);
        if (ImGui::Checkbox(label.c_str(), &fill))
            batch_.change(selected_, [&](MeshEntry& e) { e.fill = fill; });
        record_item("mesh/fill");
        const std::string what = print("with %d triangles, %.2g %% of the surface", filling.triangles,
                                       100 * filling.added_area / filling.surface_area);
        item_tooltip("Closes the border " + what + ". No vertex is added or moved.");
        wrapped_text(theme.text_faint, (fill ? "Filled " : "Possible ") + what + ".");
    } else if (entry.read->repaired) {
        bool repair = entry.repair;
        if (ImGui::Checkbox("Repair it", &repair))
            batch_.change(selected_, [&](MeshEntry& e) { e.repair = repair; });
        record_item("mesh/repair");
        item_tooltip("Makes a closed, manifold surface of it. With more choices: Edit, Repair mesh, once it "
                     "is there.");
        for (const RepairStep& step : entry.read->repair_steps)
            wrapped_text(theme.text_faint, step.text);
    } else if (report.boundary_edges > 0 && entry.role == MeshRole::muscle) {
        wrapped_text(theme.text_dim,
                     "The holes are too large or too tangled to be filled here: close the surface in "
                     "a mesh program, or add it as a bone.");
    }
    for (const auto& [serious, sentence] : findings(report))
        wrapped_text(serious ? theme.warning : theme.text_dim, sentence);
    for (const std::string& note : entry.read->file.notes)
        wrapped_text(theme.text_dim, note);
}

} // namespace fascicle::editor
