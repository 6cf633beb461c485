#include "editor/commands/command_groups.hpp"

#include "editor/features.hpp"

namespace fascicle::editor {

using C = Command;
using namespace keys;

namespace {

const LessonPlayer& player(const EditorContext& context) {
    return context.features.lessons;
}

CommandState next_state(const EditorContext& context) {
    if (!player(context).active())
        return only_if(false, "no lesson is on");
    if (player(context).on_last_step())
        return only_if(false, "this is the last step");
    return only_if(player(context).done(player(context).step_index()), "what the step asks for comes first");
}

} // namespace

std::vector<KeyBinding> lesson_commands() {
    const char* const group = "Lessons";
    return {
        {C::lesson_next,
         group,
         "Next step",
         "The next step of the lesson.",
         {{{key_right, alt}}},
         false,
         next_state,
         [](EditorContext& c) { c.features.lessons.go_to(c.features.lessons.step_index() + 1); }},
        {C::lesson_back,
         group,
         "Step before",
         "The step of the lesson before this one, as it begins.",
         {{{key_left, alt}}},
         false,
         [](const EditorContext& c) {
             return player(c).active() ? only_if(player(c).step_index() > 0, "this is the first step")
                                       : only_if(false, "no lesson is on");
         },
         [](EditorContext& c) { c.features.lessons.go_to(c.features.lessons.step_index() - 1); }},
        {C::leave_lesson,
         group,
         "Back to what was open",
         "Leaves the lesson; what was open before comes back as it was.",
         {},
         false,
         [](const EditorContext& c) { return only_if(player(c).set_aside() != nullptr, "no lesson is on"); },
         [](EditorContext& c) { c.features.lessons.leave(); }},
    };
}

} // namespace fascicle::editor
