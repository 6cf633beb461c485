#include "editor/teach/lesson_menu.hpp"

#include "editor/dialogs/dialogs.hpp"
#include "editor/features.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/tool_button.hpp"

namespace fascicle::editor {

void draw_lesson_menu(EditorContext& context) {
    LessonPlayer& player = context.features.lessons;
    const bool open = ImGui::BeginMenu("Lessons");
    record_item("menu/Lessons");
    if (!open)
        return;
    for (const LessonInfo& lesson : lessons()) {
        const bool on = player.active() && player.lesson().id == lesson.id;
        if (ImGui::MenuItem(lesson.title.c_str(), (std::to_string(lesson.minutes) + " min").c_str(), on))
            player.start(lesson.id);
        record_item("menu/lesson/" + lesson.id);
        item_tooltip(lesson.sentence + "\nWhat is open now comes back when the lesson is left.");
    }
    ImGui::Separator();
    if (ImGui::MenuItem("Open a lesson file"))
        context.dialogs.pick.open(
            "Open lesson", {".json"}, "Begin",
            [](EditorContext& c, const std::filesystem::path& path) { c.features.lessons.start_file(path); });
    record_item("menu/lesson/file");
    item_tooltip("A lesson of your own as JSON; docs/formats.md describes it.");
    for (const Command command : {Command::lesson_back, Command::lesson_next, Command::leave_lesson})
        menu_item(context, command);
    ImGui::EndMenu();
}

} // namespace fascicle::editor
