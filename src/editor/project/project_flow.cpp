#include "editor/project/project_flow.hpp"

#include "editor/dialogs/dialogs.hpp"
#include "editor/features.hpp"
#include "fascicle/io/fibre_template_file.hpp"

namespace fascicle::editor {

namespace fs = std::filesystem;

const Document& user_document(const EditorContext& context) {
    const Document* aside = context.features.lessons.set_aside();
    return aside != nullptr ? *aside : context.document;
}

void unless_unsaved(EditorContext& context, const std::string& doing, Then then) {
    if (context.features.lessons.set_aside() != nullptr) {
        if (!user_document(context).dirty())
            return then(context);
        context.features.lessons.leave();
        context.log.add(Severity::warning, user_document(context).scene().name +
                                               " is back, with unsaved changes: save them before " + doing);
        return;
    }
    if (context.document.dirty())
        context.dialogs.unsaved.ask(doing, std::move(then));
    else
        then(context);
}

void save_project(EditorContext& context, Then then) {
    if (context.document.path().empty())
        save_project_as(context, std::move(then));
    else
        context.features.project.save(context, context.document.path(),
                                      context.features.project.carry_meshes(), std::move(then));
}

void save_project_as(EditorContext& context, Then then) {
    context.dialogs.save.open(suggested_file(context), context.features.project.carry_meshes(),
                              std::move(then));
}

void new_project(EditorContext& context) {
    unless_unsaved(context, "starting a new scene", [](EditorContext& c) { open_empty_scene(c, true); });
}

void open_empty_scene(EditorContext& context, bool start_page) {
    OpenedScene opened;
    opened.scene = empty_scene();
    opened.start_page = start_page;
    context.features.opener.open_scene(std::move(opened));
}

void choose_project(EditorContext& context) {
    context.dialogs.open_project.open(context.document.path());
}

void open_project(EditorContext& context, const fs::path& path) {
    unless_unsaved(context, "opening " + path.filename().string(),
                   [path](EditorContext& c) { c.features.opener.open_project(path); });
}

void open_embedded_scene(EditorContext& context, const std::string& name) {
    unless_unsaved(context, "opening " + name,
                   [name](EditorContext& c) { c.features.opener.open_embedded(name); });
}

void quit(EditorContext& context) {
    unless_unsaved(context, "closing the program", [](EditorContext& c) { c.state.wants_quit = true; });
}

Scene empty_scene() {
    Scene scene;
    scene.name = "untitled";
    scene.fibre_templates = std::shared_ptr<const std::vector<FibreTemplate>>(std::shared_ptr<void>(),
                                                                              &built_in_fibre_templates());
    return scene;
}

fs::path suggested_file(const EditorContext& context) {
    if (!context.document.path().empty())
        return context.document.path();
    std::string stem;
    for (const char c : context.document.scene().name) // a name that every file system takes
        stem += static_cast<unsigned char>(c) < 32 ||
                        std::string_view("/\\:*?\"<>|").find(c) != std::string_view::npos
                    ? '_'
                    : c;
    std::error_code error;
    const fs::path folder = fs::current_path(error);
    fs::path path = folder / ((stem.empty() ? "untitled" : stem) + ".fascicle");
    for (int k = 2; fs::exists(path, error) && k < 10000; ++k)
        path = folder / (stem + " " + std::to_string(k) + ".fascicle");
    return path;
}

} // namespace fascicle::editor
