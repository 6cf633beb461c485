#include "editor/commands/command_groups.hpp"
#include "editor/features.hpp"
#include "editor/playback.hpp"
#include "fascicle/document/actions/marker_actions.hpp"

namespace fascicle::editor {

using C = Command;
using namespace keys;

namespace {

void step(EditorContext& context, int frames) {
    context.state.playback.playing = false;
    context.move_playhead(context.playhead() + frames);
}

void play_pause(EditorContext& context) {
    Playback& playback = context.state.playback;
    playback.playing = !playback.playing;
    if (!playback.playing)
        return;
    const auto [low, high] = played_range(playback, context.last_frame());
    const int end = std::min(high, context.available_frames() - 1);
    playback.turned = false;
    const bool more = context.features.compare.active() ? context.frames_come() : context.runs.running();
    if (playback.speed > 0 && context.playhead() >= end && !more)
        playback.position = low;
    if (playback.speed < 0 && context.playhead() <= low)
        playback.position = end;
}

/// Switches one way of repeating on, or off.
template <Repeat repeat>
KeyBinding repeat_row(Command command, const char* label, const char* help) {
    return {command,
            "Timeline",
            label,
            help,
            {},
            false,
            [](const EditorContext& c) { return checked(c.state.playback.repeat == repeat); },
            [](EditorContext& c) {
                Playback& playback = c.state.playback;
                playback.repeat = playback.repeat == repeat ? Repeat::once : repeat;
                playback.turned = false;
            }};
}

/// The playhead becomes the first or the last frame played.
void set_range(EditorContext& context, bool first) {
    auto [low, high] = played_range(context.state.playback, context.last_frame());
    (first ? low : high) = context.playhead();
    if (low > high)
        (first ? high : low) = first ? context.last_frame() : 0;
    context.state.playback.range = {low, high};
}

/// The nearest marker before or behind the playhead, or null.
const Marker* neighbour(const EditorContext& context, bool behind) {
    const Marker* found = nullptr;
    for (const Marker& marker : context.document.scene().markers) {
        if (behind && marker.frame > context.playhead())
            return &marker;
        if (!behind && marker.frame < context.playhead())
            found = &marker;
    }
    return found;
}

void go_to_marker(EditorContext& context, bool behind) {
    if (const Marker* marker = neighbour(context, behind))
        step(context, marker->frame - context.playhead());
}

KeyBinding marker_row() {
    KeyBinding row{Command::add_marker,
                   "Timeline",
                   "Add marker",
                   "Names the frame at the playhead.",
                   {{{key_m}}},
                   false,
                   [](const EditorContext& c) {
                       return only_if(actions::marker_at(c.document.scene(), c.playhead()) < 0,
                                      "there is a marker at this frame");
                   },
                   [](EditorContext& c) { actions::add_marker(c.document, c.playhead()); }};
    row.where = KeysIn::looking;
    return row;
}

} // namespace

std::vector<KeyBinding> timeline_commands() {
    const char* const time = "Timeline";
    return {
        {C::play_pause,
         time,
         "Play / pause",
         "Plays the computed frames and waits for those to come.",
         {{{key_space}}},
         false,
         [](const EditorContext& c) {
             return only_if(c.available_frames() > 0 || c.frames_come(), "no frames yet");
         },
         play_pause},
        {C::step_back,
         time,
         "One frame back",
         "Moves the playhead.",
         {{{key_left}}},
         true,
         nullptr,
         [](EditorContext& c) { step(c, -1); }},
        {C::step_on,
         time,
         "One frame on",
         "Moves the playhead.",
         {{{key_right}}},
         true,
         nullptr,
         [](EditorContext& c) { step(c, 1); }},
        {C::step_back_10,
         time,
         "Ten frames back",
         "Moves the playhead.",
         {{{key_left, shift}}},
         true,
         nullptr,
         [](EditorContext& c) { step(c, -10); }},
        {C::step_on_10,
         time,
         "Ten frames on",
         "Moves the playhead.",
         {{{key_right, shift}}},
         true,
         nullptr,
         [](EditorContext& c) { step(c, 10); }},
        {C::first_frame,
         time,
         "First frame",
         "Moves the playhead to rest.",
         {{{key_home}}},
         false,
         nullptr,
         [](EditorContext& c) { step(c, -c.playhead()); }},
        {C::last_frame,
         time,
         "Last frame",
         "Moves the playhead to the last computed frame.",
         {{{key_end}}},
         false,
         nullptr,
         [](EditorContext& c) { step(c, c.runs.available_count() - 1 - c.playhead()); }},
        repeat_row<Repeat::loop>(C::toggle_loop, "Loop", "Starts again at the end."),
        repeat_row<Repeat::ping_pong>(C::toggle_ping_pong, "Ping-pong", "Plays there and back."),
        {C::toggle_every_frame,
         time,
         "Every frame",
         "Leaves no frame out, however long it takes; else real time.",
         {},
         false,
         [](const EditorContext& c) { return checked(c.state.playback.every_frame); },
         [](EditorContext& c) { c.state.playback.every_frame = !c.state.playback.every_frame; }},
        {C::loop_from_here,
         time,
         "Play from here",
         "The playhead becomes the first frame that is played.",
         {{{key_left_bracket, ctrl}}},
         false,
         nullptr,
         [](EditorContext& c) { set_range(c, true); }},
        {C::loop_to_here,
         time,
         "Play to here",
         "The playhead becomes the last frame that is played.",
         {{{key_right_bracket, ctrl}}},
         false,
         nullptr,
         [](EditorContext& c) { set_range(c, false); }},
        {C::loop_everything,
         time,
         "Play everything",
         "Plays all frames again.",
         {},
         false,
         [](const EditorContext& c) {
             return only_if(c.state.playback.range.has_value(), "all frames are played");
         },
         [](EditorContext& c) { c.state.playback.range.reset(); }},
        marker_row(),
        {C::previous_marker,
         time,
         "Previous marker",
         "Moves the playhead.",
         {{{key_comma}}},
         true,
         [](const EditorContext& c) {
             return only_if(neighbour(c, false) != nullptr, "no marker before the playhead");
         },
         [](EditorContext& c) { go_to_marker(c, false); }},
        {C::next_marker,
         time,
         "Next marker",
         "Moves the playhead.",
         {{{key_period}}},
         true,
         [](const EditorContext& c) {
             return only_if(neighbour(c, true) != nullptr, "no marker behind the playhead");
         },
         [](EditorContext& c) { go_to_marker(c, true); }},
        {C::run_again,
         time,
         "Compute again",
         "Starts the simulation from rest.",
         {{{key_f5}}},
         false,
         [](const EditorContext& c) {
             return only_if(!c.document.scene().muscles.empty(), "the scene has no muscle");
         },
         [](EditorContext& c) { c.runs.restart(); }},
        {C::cancel_run,
         time,
         "Stop computing",
         "Ends the run; the frames so far stay.",
         {{{key_f5, shift}}},
         false,
         [](const EditorContext& c) { return only_if(c.runs.running(), "nothing is being computed"); },
         [](EditorContext& c) {
             c.runs.cancel();
             c.log.add(Severity::note, "Run stopped; the frames so far stay.");
         }},
    };
}

} // namespace fascicle::editor
