#include "editor/viewport_tool.hpp"

#include "editor/features.hpp"
#include "editor/scene_view.hpp"
#include "editor/viewport/compare_overlay.hpp"
#include "editor/viewport/recording_badge.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/legend.hpp"
#include "editor/widgets/paint.hpp"
#include "view/build_draw_list.hpp"

namespace fascicle::editor {

namespace {

using C = Command;

ImU32 packed(const render::Rgba& c) {
    return ImGui::ColorConvertFloat4ToU32({c[0], c[1], c[2], c[3]});
}

std::vector<LegendEntry> attachment_entries(const EditorContext& context) {
    bool origin = false, insertion = false, unknown = false;
    const RecordingPtr recording = context.shown().recording;
    const Scene& scene = context.shown_scene();
    std::vector<std::vector<Attachment>> lists =
        recording != nullptr ? recording->attachments() : std::vector<std::vector<Attachment>>{};
    for (const Muscle& muscle : scene.muscles)
        lists.push_back(muscle.attachments);
    for (const auto& attachments : lists)
        for (const Attachment& attachment : attachments) {
            origin |= attachment.kind == AttachmentKind::origin;
            insertion |= attachment.kind == AttachmentKind::insertion;
            unknown |= attachment.kind == AttachmentKind::unknown;
        }
    for (const Muscle& muscle : context.document.scene().muscles)
        for (const AttachmentArea& area : muscle.areas) {
            origin |= area.kind == AttachmentKind::origin;
            insertion |= area.kind == AttachmentKind::insertion;
        }
    std::vector<LegendEntry> entries;
    if (origin)
        entries.push_back({"Origin", packed(view::palette::origin)});
    if (insertion)
        entries.push_back({"Insertion", packed(view::palette::insertion)});
    if (unknown)
        entries.push_back({"Attachment", packed(view::palette::attachment)});
    return entries;
}

void draw_legends(EditorContext& context, ImDrawList& list, const Rect& area) {
    if (area.height() < context.px(240) || context.features.compare.active(CompareMode::difference))
        return; // the difference map has a legend of its own
    const ImVec2 corner{area.max.x - context.px(12), area.min.y + context.px(12)};
    std::vector<LegendEntry> entries;
    const view::Colouring colouring = context.state.colouring;
    if (const view::ColouringRow& row = view::colouring_row(colouring); row.has_scale()) {
        const Rect plate = draw_colour_bar(list, corner, row.legend, context.state.colour_scales[colouring],
                                           context.theme, context.scale());
        record_item("viewport/legend", plate);
        if (context.view != nullptr && context.view->waiting())
            record_item("viewport/legend/waiting",
                        draw_badge(list, {plate.max.x, plate.max.y + context.px(6)}, Align::right,
                                   "Computing", context.theme.text_dim, context.theme.badge));
        return;
    }
    if (colouring == view::Colouring::contact)
        for (const view::ContactRow& row : view::contact_rows())
            entries.push_back({row.label, packed(row.colour)});
    else if (context.state.attachments)
        entries = attachment_entries(context);
    if (!entries.empty())
        record_item("viewport/legend", draw_swatches(list, corner, entries, context.theme, context.scale()));
}

/// A sentence when what is seen is not the computed frame at the playhead.
void draw_state(EditorContext& context, ImDrawList& list, const Rect& area) {
    if (context.features.compare.active())
        return; // labels of their own
    if (context.features.motion.preview() != nullptr)
        return; // what is seen is no frame of a run
    const ImVec2 at{area.min.x + area.width() / 2, area.min.y + context.px(12)};
    const Theme& theme = context.theme;
    const ShownFrame shown = context.shown();
    std::string text;
    ImU32 colour = theme.text;
    const RecordingPtr recording = context.runs.recording();
    const bool failed =
        recording != nullptr && recording->state() == RunState::failed && !context.runs.outdated();
    if (failed) {
        text = "The run failed: " + recording->failure();
        colour = theme.bad;
    } else if (shown.state == FrameState::stale) {
        text = context.runs.running() ? "Stale: made with other parameters, computing anew"
                                      : "Stale: made with other parameters";
        colour = theme.warning;
    } else if (shown.frame == nullptr && !context.document.scene().muscles.empty()) {
        text = context.runs.running() ? "At rest; preparing the run" : "At rest";
    } else if (shown.frame != nullptr && shown.frame->index < context.playhead()) {
        text = "Frame " + std::to_string(shown.frame->index) + "; frame " +
               std::to_string(context.playhead()) + " is not computed yet";
    }
    if (!text.empty())
        record_item("viewport/badge",
                    draw_badge(list, at, Align::centre, elided(text, context.px(520)), colour, theme.badge));
}

/// A file that is being read, with its way out.
void draw_loading(EditorContext& context, ImDrawList& list, const Rect& area) {
    const FileLoader& loader = context.features.loader;
    if (!loader.reading())
        return;
    record_item("viewport/loading",
                draw_badge(list, {area.min.x + area.width() / 2, area.max.y - context.px(40)}, Align::centre,
                           elided("Reading " + loader.what(), context.px(420)) + "; Esc cancels",
                           context.theme.text, context.theme.badge));
}

void draw_empty(EditorContext& context, ImDrawList& list, const Rect& area) {
    const Scene& scene = context.document.scene();
    if (!scene.bones.empty() || !scene.muscles.empty())
        return;
    const float middle = area.min.y + area.height() * 0.45f, line = ImGui::GetTextLineHeightWithSpacing();
    draw_text_in(list, {{area.min.x, middle - line * 1.5f}, {area.max.x, middle - line * 0.5f}},
                 context.theme.text, "Nothing here yet", Align::centre);
    draw_text_in(list, {{area.min.x, middle - line * 0.5f}, {area.max.x, middle + line * 0.5f}},
                 context.theme.text_dim,
                 "Drop a mesh of a bone or a muscle here, or press " + shortcut(C::open_file), Align::centre);
}

void draw_hovered_fibre(EditorContext& context, ImDrawList& list, const Rect& area) {
    context.features.fibre_hover.draw(context, list, area);
}

} // namespace

const std::vector<OverlayRow>& viewport_overlays() {
    static const std::vector<OverlayRow> rows{
        {"fibre", draw_hovered_fibre},
        {"legend", draw_legends},
        {"state", draw_state},
        {"motion", draw_motion_overlay},
        {"loading", draw_loading},
        {"empty", draw_empty},
        {"compare", draw_compare_overlay},
        {"recording", draw_recording_badge},
        {"quiz", draw_quiz_truth},
    };
    return rows;
}

} // namespace fascicle::editor
