#include "editor/dialogs/progress_note.hpp"

#include "editor/features.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"
#include "editor/widgets/tool_button.hpp"

namespace fascicle::editor {

void ProgressNote::draw(EditorContext& context) {
    SceneOpener& opener = context.features.opener;
    const bool opening = opener.reading() && !context.state.show_start; // the start page says so itself
    const bool saving = context.features.project.saving(), reloading = context.features.watch.reloading();
    if (!opening && !saving && !reloading) {
        since_ = -1;
        return;
    }
    if (since_ < 0)
        since_ = context.now;
    if (context.now - since_ < patience_seconds)
        return;
    const float width = context.px(300);
    ImGui::SetNextWindowPos({ImGui::GetIO().DisplaySize.x / 2, context.px(84)}, ImGuiCond_Always, {0.5f, 0});
    ImGui::SetNextWindowSize({width, 0});
    ImGui::Begin("progress note", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing);
    const std::string words = opening  ? "Opening " + opener.what()
                              : saving ? "Saving"
                                       : "Reading files again";
    const float room = ImGui::GetContentRegionAvail().x;
    ImGui::TextUnformatted(elided(words, room).c_str());
    record_item("progress/words");
    if (opening) {
        ImGui::ProgressBar(static_cast<float>(opener.progress()), {room - context.px(72), context.px(18)},
                           "");
        ImGui::SameLine(0, context.px(8));
        if (ImGui::SmallButton("Cancel"))
            opener.cancel();
        record_item("progress/cancel");
        item_tooltip("Gives up opening it; this scene stays");
    }
    ImGui::End();
}

} // namespace fascicle::editor
