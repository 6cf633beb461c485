#include "editor/start/start_sections.hpp"

#include "editor/dialogs/recovery_dialog.hpp"
#include "editor/features.hpp"
#include "editor/project/project_flow.hpp"
#include "fascicle/io/lesson_file.hpp"
#include "fascicle/io/recent_projects.hpp"
#include "fascicle/scene/embedded_scenes.hpp"

namespace fascicle::editor {

namespace fs = std::filesystem;

namespace {

std::vector<StartCard> recent_cards(EditorContext& context) {
    std::vector<StartCard> cards;
    for (const RecentProject& project : read_recent_projects(context.user_folder)) {
        std::error_code error;
        StartCard card;
        card.id = "recent/" + project.path.filename().string();
        card.title = project.path.stem().string();
        card.line = time_text(project.time);
        card.tip = project.path.string() + (project.name.empty() ? "" : "\nScene: " + project.name);
        card.picture = recent_picture(context.user_folder, project.path);
        if (!fs::exists(project.path, error))
            card.missing = "not there any more";
        card.open = [path = project.path](EditorContext& c) { open_project(c, path); };
        card.remove = [path = project.path](EditorContext& c) {
            try {
                remove_recent_project(c.user_folder, path);
            } catch (const std::exception& problem) {
                c.log.add(Severity::error, problem.what());
            }
        };
        cards.push_back(std::move(card));
    }
    return cards;
}

std::vector<StartCard> embedded_cards(EditorContext&) {
    std::vector<StartCard> cards;
    for (const EmbeddedSceneInfo& info : embedded_scenes()) {
        StartCard card;
        card.id = "scene/" + info.name;
        card.title = info.name;
        card.line = info.line;
        card.tip = info.line;
        card.embedded = info.name;
        card.open = [name = info.name](EditorContext& c) { open_embedded_scene(c, name); };
        cards.push_back(std::move(card));
    }
    return cards;
}

std::vector<StartCard> lesson_cards(EditorContext&) {
    std::vector<StartCard> cards;
    for (const Lesson& lesson : built_in_lessons()) {
        StartCard card;
        card.id = "lesson/" + lesson.id;
        card.title = lesson.title;
        card.line = lesson.sentence;
        card.tip = lesson.sentence + "\n" + std::to_string(lesson.minutes) + " minutes";
        card.embedded = lesson.scene;
        card.open = [id = lesson.id](EditorContext& c) { c.features.lessons.start(id); };
        cards.push_back(std::move(card));
    }
    return cards;
}

} // namespace

const std::vector<StartSection>& start_sections() {
    static const std::vector<StartSection> sections{
        {"Recent projects", "Projects that you save or open will be here.", recent_cards},
        {"Scenes to begin with", nullptr, embedded_cards},
        {"Lessons", nullptr, lesson_cards},
    };
    return sections;
}

} // namespace fascicle::editor
