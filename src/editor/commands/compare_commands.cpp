#include "editor/commands/command_groups.hpp"
#include "editor/dialogs/dialogs.hpp"
#include "editor/features.hpp"

namespace fascicle::editor {

using C = Command;
using namespace keys;

namespace {

const char* const group = "Compare";

CommandState comparable(const EditorContext& context) {
    const std::string& reason = context.features.compare.reason();
    return {reason.empty(), false, reason};
}

/// A way of comparing, as a switch.
template <CompareMode mode>
KeyBinding mode_row(Command command, const char* label) {
    const CompareModeRow* row = nullptr;
    for (const CompareModeRow& candidate : compare_modes())
        if (candidate.mode == mode)
            row = &candidate;
    return {command,
            group,
            label,
            row->help,
            {},
            false,
            [](const EditorContext& c) {
                CommandState state = comparable(c);
                state.checked = c.features.compare.choice.mode == mode;
                state.enabled = state.enabled || state.checked;
                return state;
            },
            [](EditorContext& c) {
                CompareMode& now = c.features.compare.choice.mode;
                now = now == mode ? CompareMode::off : mode;
            }};
}

} // namespace

std::vector<KeyBinding> compare_commands() {
    return {
        {C::toggle_compare,
         group,
         "Compare two runs",
         "Shows two runs side by side on one playhead, or stops comparing.",
         {{{key_b, shift}}},
         false,
         [](const EditorContext& c) {
             CommandState state = comparable(c);
             state.checked = c.features.compare.choice.mode != CompareMode::off;
             state.enabled = state.enabled || state.checked;
             return state;
         },
         [](EditorContext& c) {
             CompareMode& mode = c.features.compare.choice.mode;
             mode = mode == CompareMode::off ? CompareMode::side_by_side : CompareMode::off;
             if (mode != CompareMode::off) {
                 c.state.side_panel = "compare";
                 c.state.layout.show_right = true;
             }
         }},
        {C::blink_runs,
         group,
         "Blink between the runs",
         "Goes from run A to run B and back.",
         {{{key_b}}},
         false,
         comparable,
         [](EditorContext& c) { c.features.compare.blink(); }},
        {C::swap_runs,
         group,
         "Swap A and B",
         "Run A becomes B, and B becomes A.",
         {},
         false,
         [](const EditorContext& c) {
             const Compare& compare = c.features.compare;
             return only_if(compare.a().recording != nullptr && compare.b().recording != nullptr,
                            "there are no two runs");
         },
         [](EditorContext& c) { c.features.compare.swap(c); }},
        mode_row<CompareMode::side_by_side>(C::compare_side_by_side, "Side by side"),
        mode_row<CompareMode::ghost>(C::compare_ghost, "Ghost of run B"),
        mode_row<CompareMode::blink>(C::compare_blink, "Blink A and B"),
        mode_row<CompareMode::difference>(C::compare_difference, "Difference map"),
        {C::load_run,
         group,
         "Load a run folder...",
         "Reads a run that 'fascicle simulate --export vtp' left, to compare with.",
         {},
         false,
         nullptr,
         [](EditorContext& c) { c.dialogs.run.open(); }},
    };
}

} // namespace fascicle::editor
