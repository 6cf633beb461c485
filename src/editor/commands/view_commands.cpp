#include "editor/commands/command_groups.hpp"
#include "editor/fly_to_worst.hpp"

#include <numbers>

namespace fascicle::editor {

using C = Command;
using namespace keys;
using view::StandardView;

namespace {

constexpr double orbit_step = 15 * std::numbers::pi / 180;
const char* const view_group = "View";

template <StandardView standard>
void look(EditorContext& context) {
    context.state.camera.look_from(standard);
}

template <std::size_t slot>
KeyBinding store_row(Command command, const char* label) {
    return {command,
            view_group,
            label,
            "Keeps the present view.",
            {{{key_1 + static_cast<int>(slot), ctrl}}},
            false,
            nullptr,
            [](EditorContext& c) { c.state.camera_slots[slot] = c.state.camera; }};
}

template <std::size_t slot>
KeyBinding recall_row(Command command, const char* label) {
    KeyBinding row{command,
                   view_group,
                   label,
                   "Goes back to the kept view.",
                   {{{key_1 + static_cast<int>(slot)}}},
                   false,
                   [](const EditorContext& c) {
                       return only_if(c.state.camera_slots[slot].has_value(), "no view kept there");
                   },
                   [](EditorContext& c) { c.state.camera = *c.state.camera_slots[slot]; }};
    row.where = KeysIn::looking;
    return row;
}

} // namespace

std::vector<KeyBinding> view_commands() {
    const char* const view = view_group;
    return {
        {C::frame_selection,
         view,
         "Frame selection",
         "Fills the view with what is selected.",
         {{{key_f}}},
         false,
         needs_selection,
         [](EditorContext& c) {
             c.state.camera.frame(object_bounds(c, c.state.selection), c.state.view_aspect);
         }},
        {C::frame_all,
         view,
         "Frame everything",
         "Fills the view with the whole scene.",
         {{{key_f, shift}}},
         false,
         nullptr,
         [](EditorContext& c) { c.state.camera.frame(scene_bounds(c), c.state.view_aspect); }},
        {C::fly_to_worst,
         view,
         "Fly to worst vertex",
         "Shows the deepest vertex inside a bone in this frame, or the free one nearest to a bone.",
         {{{key_x}}},
         false,
         [](const EditorContext& c) {
             return only_if(!c.shown_scene().muscles.empty() && !c.shown_scene().bones.empty(),
                            "the scene needs a muscle and a bone");
         },
         [](EditorContext& c) { fly_to_worst(c); }},
        {C::view_anterior,
         view,
         "Anterior",
         "Looks at the front.",
         {{pad(1)}},
         false,
         nullptr,
         look<StandardView::anterior>},
        {C::view_posterior,
         view,
         "Posterior",
         "Looks at the back.",
         {{pad(1, shift)}},
         false,
         nullptr,
         look<StandardView::posterior>},
        {C::view_left,
         view,
         "Left",
         "Looks at the left side.",
         {{pad(3)}},
         false,
         nullptr,
         look<StandardView::left>},
        {C::view_right,
         view,
         "Right",
         "Looks at the right side.",
         {{pad(3, shift)}},
         false,
         nullptr,
         look<StandardView::right>},
        {C::view_superior,
         view,
         "Superior",
         "Looks from above.",
         {{pad(7)}},
         false,
         nullptr,
         look<StandardView::superior>},
        {C::view_inferior,
         view,
         "Inferior",
         "Looks from below.",
         {{pad(7, shift)}},
         false,
         nullptr,
         look<StandardView::inferior>},
        {C::orbit_left,
         view,
         "Turn left",
         "Orbits by 15 degrees.",
         {{pad(4)}},
         true,
         nullptr,
         [](EditorContext& c) { c.state.camera.orbit_by(-orbit_step, 0); }},
        {C::orbit_right,
         view,
         "Turn right",
         "Orbits by 15 degrees.",
         {{pad(6)}},
         true,
         nullptr,
         [](EditorContext& c) { c.state.camera.orbit_by(orbit_step, 0); }},
        {C::orbit_up,
         view,
         "Turn up",
         "Orbits by 15 degrees.",
         {{pad(8)}},
         true,
         nullptr,
         [](EditorContext& c) { c.state.camera.orbit_by(0, orbit_step); }},
        {C::orbit_down,
         view,
         "Turn down",
         "Orbits by 15 degrees.",
         {{pad(2)}},
         true,
         nullptr,
         [](EditorContext& c) { c.state.camera.orbit_by(0, -orbit_step); }},
        {C::toggle_orthographic,
         view,
         "Orthographic",
         "Switches perspective off: parallels stay parallel.",
         {{{key_p}, pad(5)}},
         false,
         [](const EditorContext& c) { return checked(c.state.camera.orthographic()); },
         [](EditorContext& c) { c.state.camera.set_orthographic(!c.state.camera.orthographic()); }},
        store_row<0>(C::store_camera_1, "Store camera 1"),
        store_row<1>(C::store_camera_2, "Store camera 2"),
        store_row<2>(C::store_camera_3, "Store camera 3"),
        store_row<3>(C::store_camera_4, "Store camera 4"),
        recall_row<0>(C::recall_camera_1, "Camera 1"),
        recall_row<1>(C::recall_camera_2, "Camera 2"),
        recall_row<2>(C::recall_camera_3, "Camera 3"),
        recall_row<3>(C::recall_camera_4, "Camera 4"),
    };
}

} // namespace fascicle::editor
