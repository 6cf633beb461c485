#include "editor/commands/command_groups.hpp"

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
    const bool at_end = context.playhead() >= context.runs.available_count() - 1;
    if (playback.playing && at_end && !context.runs.running())
        playback.position = 0;
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
             return only_if(c.runs.available_count() > 0 || c.runs.running(), "no frames yet");
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
        {C::toggle_loop,
         time,
         "Loop",
         "Starts again at the end.",
         {},
         false,
         [](const EditorContext& c) { return checked(c.state.playback.loop); },
         [](EditorContext& c) { c.state.playback.loop = !c.state.playback.loop; }},
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
