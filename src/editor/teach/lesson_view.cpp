// The view settings of a lesson's steps, by their names in the file.
#include "editor/features.hpp"
#include "editor/panel.hpp"
#include "fascicle/base/error.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::editor {

namespace {

constexpr std::pair<const char*, bool EditorState::*> switches[] = {
    {"wireframe", &EditorState::wireframe},
    {"attachments", &EditorState::attachments},
    {"rest_ghost", &EditorState::rest_ghost},
    {"joint_axis", &EditorState::joint_axis},
};

constexpr std::pair<const char*, view::StandardView> sides[] = {
    {"anterior", view::StandardView::anterior}, {"posterior", view::StandardView::posterior},
    {"left", view::StandardView::left},         {"right", view::StandardView::right},
    {"superior", view::StandardView::superior}, {"inferior", view::StandardView::inferior},
};

const view::ColouringRow* find_colouring(const std::string& key) {
    for (const view::ColouringRow& row : view::colourings())
        if (key == row.key)
            return &row;
    return nullptr;
}

bool is_switch(const std::string& key) {
    return key == "play" || std::any_of(std::begin(switches), std::end(switches),
                                        [&](const auto& row) { return key == row.first; });
}

bool is_panel(const std::string& id, Place place) {
    return std::any_of(panel_registry().begin(), panel_registry().end(),
                       [&](const PanelRow& row) { return id == row.id && row.place == place; });
}

/// What is wrong with a setting; empty when nothing is.
std::string fault(const std::string& key, const std::string& text) {
    double number = 0;
    if (key == "colouring" && find_colouring(text) == nullptr)
        return "no colouring '" + text + "'";
    if (key == "frame" && (!parse_number(text, number) || number < 0 || number > 3e6))
        return "frame '" + text + "' is no number from 0 to 3000000";
    if (key == "bone_opacity" && (!parse_number(text, number) || number < 0 || number > 1))
        return "bone_opacity '" + text + "' is no number from 0 to 1";
    if (is_switch(key) && text != "on" && text != "off")
        return key + " '" + text + "' is neither on nor off";
    if (key == "side_panel" && !is_panel(text, Place::parameters))
        return "no panel '" + text + "' at the side";
    if (key == "bottom_panel" && !is_panel(text, Place::bottom))
        return "no panel '" + text + "' below";
    if (key == "look" &&
        std::none_of(std::begin(sides), std::end(sides), [&](const auto& row) { return text == row.first; }))
        return "no side '" + text + "' to look from";
    return {};
}

bool is_command(std::string_view label) {
    return std::any_of(key_bindings().begin(), key_bindings().end(),
                       [&](const KeyBinding& row) { return label == row.label; });
}

} // namespace

void check_controls(const Lesson& lesson) {
    for (const LessonStep& step : lesson.steps) {
        const std::string where = lesson.id + ", step '" + step.title + "'";
        for (const auto& [key, text] : step.view)
            if (const std::string what = fault(key, text); !what.empty())
                throw_error(where, what);
        for (const LessonCheck& check : step.checks)
            if (check.what == "view")
                if (const std::string what = fault(check.key, check.is); !what.empty())
                    throw_error(where, what);
        for (const auto* names : {&step.locked, &step.highlighted})
            for (const std::string& name : *names) {
                constexpr std::string_view command = "command/";
                if (name.starts_with(command) && name.back() != '*' &&
                    !is_command(std::string_view(name).substr(command.size())))
                    throw_error(where, "no command '" + name.substr(command.size()) + "'");
            }
    }
}

void apply_view(EditorContext& context, const std::vector<std::pair<std::string, std::string>>& view) {
    EditorState& state = context.state;
    if (std::any_of(view.begin(), view.end(), [](const auto& row) { return row.first == "hide"; }))
        state.hidden.clear();
    for (const auto& [key, text] : view) {
        for (const auto& [name, member] : switches)
            if (key == name)
                state.*member = text == "on";
        if (key == "colouring")
            state.colouring = find_colouring(text)->colouring;
        else if (key == "play")
            state.playback.playing = text == "on";
        else if (key == "side_panel")
            state.side_panel = text;
        else if (key == "bottom_panel")
            state.bottom_panel = text;
        else if (key == "hide" && text != "none")
            state.hidden.insert(text);
        else if (key == "frame") {
            double frame = 0;
            parse_number(text, frame);
            context.move_playhead(static_cast<int>(frame));
        } else if (key == "bone_opacity") {
            double opacity = 1;
            parse_number(text, opacity);
            state.bone_opacity = static_cast<float>(opacity);
        } else if (key == "look") {
            for (const auto& [name, side] : sides)
                if (text == name)
                    state.camera.look_from(side);
        } else if (key == "select") {
            const Scene& scene = context.document.scene();
            state.selection = scene.bone_index(text) >= 0     ? Selection{Selection::Kind::bone, text}
                              : scene.muscle_index(text) >= 0 ? Selection{Selection::Kind::muscle, text}
                                                              : Selection{};
        }
    }
}

std::string view_text(const EditorState& state, const std::string& key, const std::string& wanted) {
    for (const auto& [name, member] : switches)
        if (key == name)
            return state.*member ? "on" : "off";
    if (key == "colouring")
        return view::colouring_row(state.colouring).key;
    if (key == "play")
        return state.playback.playing ? "on" : "off";
    if (key == "side_panel")
        return state.side_panel;
    if (key == "bottom_panel")
        return state.bottom_panel;
    if (key == "select")
        return state.selection.name;
    if (key == "frame")
        return std::to_string(state.playback.playhead());
    if (key == "bone_opacity") { // 0.4, as it is written, not the float next to it
        const double opacity = static_cast<double>(state.bone_opacity);
        return number_text(std::round(1e4 * opacity) / 1e4);
    }
    if (key == "hide")
        return state.visible(wanted) ? std::string() : wanted;
    return {};
}

} // namespace fascicle::editor
