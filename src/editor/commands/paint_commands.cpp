#include "editor/commands/command_groups.hpp"
#include "editor/features.hpp"

namespace fascicle::editor {

using C = Command;
using namespace keys;

namespace {

const char* const group = "Paint";

CommandState painting(const EditorContext& context) {
    return only_if(context.state.tool == Tool::paint, "only while painting");
}

template <PaintKind kind>
KeyBinding kind_row(Command command, const char* label, const char* help, int key) {
    return {command,
            group,
            label,
            help,
            {{{key}}},
            false,
            [](const EditorContext& c) {
                CommandState state = painting(c);
                state.checked = state.enabled && c.features.paint.settings.kind == kind;
                return state;
            },
            [](EditorContext& c) { c.features.paint.settings.choose(kind); },
            KeysIn::painting};
}

template <AttachmentKind kind>
KeyBinding label_row(Command command, const char* label, const char* help, int key) {
    return {command,
            group,
            label,
            help,
            {{{key}}},
            false,
            [](const EditorContext& c) {
                CommandState state = painting(c);
                state.checked = state.enabled && c.features.paint.settings.label == kind;
                return state;
            },
            [](EditorContext& c) { c.features.paint.settings.label = kind; },
            KeysIn::painting};
}

template <AreaOperation operation>
KeyBinding operation_row(Command command, const char* label, const char* help, KeyChord chord = {}) {
    return {command,
            group,
            label,
            help,
            {{chord}},
            true,
            [](const EditorContext& c) { return c.features.paint.can_apply(c, operation); },
            [](EditorContext& c) { c.features.paint.apply(c, operation); },
            KeysIn::painting};
}

KeyBinding simple_row(Command command, const char* label, const char* help, KeyChord chord, bool repeats,
                      void (*run)(EditorContext&)) {
    return {command, group, label, help, {{chord}}, repeats, painting, run, KeysIn::painting};
}

void toggle_eraser(EditorContext& context) {
    PaintSettings& settings = context.features.paint.settings;
    settings.choose(settings.kind == PaintKind::eraser ? settings.before_eraser : PaintKind::eraser);
}

CommandState mirror_state(const EditorContext& context) {
    CommandState state = painting(context);
    const PaintMode& paint = context.features.paint;
    if (!state.enabled)
        return state;
    if (const PaintMirror mirror = paint.mirror(context); !mirror.stroke && !paint.settings.mirror)
        return {false, false, mirror.reason.empty() ? "nothing is painted on" : mirror.reason};
    state.checked = paint.settings.mirror;
    return state;
}

CommandState line_state(const EditorContext& context) {
    return only_if(context.state.tool == Tool::paint && context.features.paint_tool.line_points() > 0,
                   "no line is being drawn");
}

} // namespace

std::vector<KeyBinding> paint_commands() {
    return {
        {C::paint_mode,
         group,
         "Paint attachments",
         "Paints origins and insertions on the selected bone; again to end.",
         {{{key_tab}}},
         false,
         [](const EditorContext& c) {
             return c.state.tool == Tool::paint ? checked(true) : c.features.paint.can_enter(c);
         },
         [](EditorContext& c) {
             if (c.state.tool == Tool::paint)
                 c.features.paint.leave(c);
             else
                 c.features.paint.enter(c);
         }},
        kind_row<PaintKind::brush>(C::paint_brush, "Brush",
                                   "Paints where it is drawn. Ctrl erases, Shift smooths.", key_1),
        kind_row<PaintKind::eraser>(C::paint_eraser, "Eraser", "Takes away from the area.", key_2),
        kind_row<PaintKind::smooth>(C::paint_smooth, "Smooth",
                                    "Smooths the border under the brush and keeps the area's size.", key_3),
        kind_row<PaintKind::smart_fill>(C::paint_smart_fill, "Smart fill",
                                        "Fills up to where faces meet at more than the crease angle.", key_4),
        kind_row<PaintKind::bucket>(C::paint_bucket, "Bucket",
                                    "Fills up to a painted border. Ctrl takes away an island.", key_5),
        kind_row<PaintKind::lasso>(C::paint_lasso, "Lasso", "Takes what is seen inside a line drawn by hand.",
                                   key_6),
        kind_row<PaintKind::line>(
            C::paint_line, "Line",
            "Shortest lines along the surface from click to click: closed they enclose an area, "
            "open they are as wide as the brush.",
            key_7),
        label_row<AttachmentKind::origin>(C::paint_origin, "Origin", "Paints the end that stays.", key_o),
        label_row<AttachmentKind::insertion>(C::paint_insertion, "Insertion", "Paints the end that moves.",
                                             key_i),
        simple_row(C::paint_toggle_eraser, "Eraser on / off",
                   "Changes between the eraser and the tool before it.", {key_e}, false, toggle_eraser),
        simple_row(C::paint_smaller_radius, "Smaller brush",
                   "Radius down by a fifth; also Shift and the wheel.", {key_left_bracket}, true,
                   [](EditorContext& c) { c.features.paint.settings.scale_radius(1 / 1.2); }),
        simple_row(C::paint_larger_radius, "Larger brush", "Radius up by a fifth; also Shift and the wheel.",
                   {key_right_bracket}, true,
                   [](EditorContext& c) { c.features.paint.settings.scale_radius(1.2); }),
        operation_row<AreaOperation::shrink>(
            C::paint_shrink, "Shrink", "Takes one ring of vertices off the area.", {key_left_bracket, shift}),
        operation_row<AreaOperation::grow>(C::paint_grow, "Grow", "Adds one ring of vertices to the area.",
                                           {key_right_bracket, shift}),
        {C::paint_mirror,
         group,
         "Mirror",
         "Paints on the other side too: the pair by suffix _l and _r, or the other half of the same bone.",
         {{{key_m}}},
         false,
         mirror_state,
         [](EditorContext& c) { c.features.paint.settings.mirror = !c.features.paint.settings.mirror; },
         KeysIn::painting},
        {C::paint_finish_line,
         group,
         "End the line",
         "Paints a strip as wide as the brush along the line.",
         {{{key_enter}, {key_pad_enter}}},
         false,
         line_state,
         [](EditorContext& c) { c.features.paint_tool.finish_line(c); },
         KeysIn::painting},
        {C::paint_line_back,
         group,
         "Last point back",
         "Takes back the last point of the line.",
         {{{key_backspace}}},
         true,
         line_state,
         [](EditorContext& c) { c.features.paint_tool.line_back(); },
         KeysIn::painting},
        operation_row<AreaOperation::keep_largest>(C::paint_keep_largest, "Keep the largest",
                                                   "Takes away all islands but the largest."),
        operation_row<AreaOperation::fill_holes>(C::paint_fill_holes, "Fill holes",
                                                 "Adds what the area encloses."),
        operation_row<AreaOperation::invert>(C::paint_invert, "Invert",
                                             "What is painted and what is not change places."),
        operation_row<AreaOperation::clear>(C::paint_clear, "Clear", "Takes the whole area away."),
        simple_row(C::paint_camera, "Camera while held",
                   "With V or Alt held the left button moves the camera; the other buttons always do.",
                   {key_v}, false, nullptr),
    };
}

} // namespace fascicle::editor
