#include "editor/presets/preset_bar.hpp"

#include "editor/control_guard.hpp"
#include "editor/features.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"
#include "editor/widgets/tool_button.hpp"

#include <imgui_stdlib.h>

namespace fascicle::editor {

namespace {

/// What a preset is for, and the first of what it would change.
std::string describe(const Preset& preset, const ParamSet& parameters) {
    constexpr std::size_t most_lines = 12;
    std::string text = preset.label;
    if (!preset.meaning.empty())
        text += "\n" + preset.meaning;
    const std::vector<PresetChange> changes = preset_changes(preset, parameters);
    text += changes.empty() ? "\n\nIn force now." : "\n\nWould change:";
    for (std::size_t i = 0; i < changes.size() && i < most_lines; ++i)
        text += "\n" + changes[i].label + ": " + changes[i].before + " to " + changes[i].after;
    if (changes.size() > most_lines)
        text += "\nand " + std::to_string(changes.size() - most_lines) + " more";
    if (!preset.file.empty())
        text += "\n\nYour own: " + preset.file.string();
    return text;
}

} // namespace

void PresetBar::draw(EditorContext& context) {
    PresetStore& store = context.features.presets;
    const LockScope lock("parameters/presets");
    const float height = ImGui::GetFrameHeight(), width = ImGui::GetContentRegionAvail().x;
    if (version_ != context.document.version()) {
        version_ = context.document.version();
        in_force_.clear();
        for (const Preset& preset : store.all(context))
            if (in_force_.empty() && preset_changes(preset, context.document.scene().parameters).empty())
                in_force_ = preset.label;
    }
    ImGui::SetNextItemWidth(std::max(20.0f, width - height - context.px(4)));
    const bool open = ImGui::BeginCombo(
        "##presets", in_force_.empty() ? "Choose a preset" : in_force_.c_str(), ImGuiComboFlags_HeightLarge);
    const Rect frame{ImGui::GetItemRectMin(), ImGui::GetItemRectMax()};
    if (!open)
        item_tooltip(
            lock.tip("Presets\nNamed values for many parameters at once; one undo step. On the command line: "
                     "--preset NAME."));
    if (open) {
        draw_list(context);
        ImGui::EndCombo();
    }
    record_item("parameters/presets", frame);
    ImGui::SameLine(0, context.px(4));
    if (icon_button(context, "parameters/keep", icons::plus, false, !context.user_folder.empty(),
                    context.user_folder.empty()
                        ? "Keep these values as a preset\nNot now: there is no folder to keep "
                          "it in."
                        : "Keep these values as a preset of your own",
                    height / context.scale())) {
        name_.clear();
        ImGui::OpenPopup("keep preset");
    }
    draw_keep(context);
}

void PresetBar::draw_list(EditorContext& context) {
    PresetStore& store = context.features.presets;
    const ParamSet& parameters = context.document.scene().parameters;
    const std::vector<Preset>& presets = store.all(context);
    const Preset* removed = nullptr;
    bool own_begun = false;
    const float side = ImGui::GetTextLineHeight(), room = ImGui::GetContentRegionAvail().x;
    for (const Preset& preset : presets) {
        const bool own = !preset.file.empty();
        if (own && !own_begun)
            ImGui::Separator();
        own_begun |= own;
        ImGui::PushID(own ? preset.file.c_str() : preset.key.c_str());
        const bool in_force = preset_changes(preset, parameters).empty();
        if (ImGui::Selectable(preset.label.c_str(), in_force, 0,
                              {own ? room - side - context.px(10) : 0.0f, 0}))
            store.apply(context, preset);
        record_item("parameters/presets/" + preset.key);
        if (ImGui::IsItemHovered())
            item_tooltip(describe(preset, parameters));
        if (own) {
            ImGui::SameLine();
            const std::string name = "parameters/presets/" + preset.key + "/delete";
            if (icon_button(context, name.c_str(), icons::trash, false, true,
                            "Delete this preset of yours: " + preset.file.string(), side / context.scale()))
                removed = &preset;
        }
        ImGui::PopID();
    }
    if (removed != nullptr) {
        store.remove(context, *removed);
        version_ = 0; // it may have been the one in force
    }
}

void PresetBar::draw_keep(EditorContext& context) {
    if (!ImGui::BeginPopup("keep preset"))
        return;
    PresetStore& store = context.features.presets;
    ImGui::TextUnformatted("Keep the changed values as");
    if (ImGui::IsWindowAppearing())
        ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(context.px(220));
    const bool entered = ImGui::InputText("##name", &name_, ImGuiInputTextFlags_EnterReturnsTrue);
    record_item("parameters/keep/name");
    item_tooltip("Name of the preset\nAlso what --preset takes, in small letters.");
    const std::string fault = name_.empty() ? std::string() : store.fault_of(context, name_);
    ImGui::PushStyleColor(ImGuiCol_Text, fault.empty() ? context.theme.text_faint : context.theme.warning);
    ImGui::TextUnformatted(!fault.empty() ? ("Not possible: " + fault).c_str()
                           : !name_.empty() && store.replaces(name_)
                               ? "Replaces your preset of this name."
                               : "The method and every value you changed.");
    ImGui::PopStyleColor();
    const bool ready = !name_.empty() && fault.empty();
    ImGui::BeginDisabled(!ready);
    const bool pressed = ImGui::Button("Keep", {context.px(90), 0});
    record_item("parameters/keep/ok");
    ImGui::EndDisabled();
    if (ready && (pressed || entered) && store.save(context, name_)) {
        version_ = 0; // it is in force
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

} // namespace fascicle::editor
