#pragma once
// What New, Open, Save and Quit do, step by step, with the questions that they ask on the way.

#include "editor/editor_context.hpp"

#include <functional>

namespace fascicle::editor {

using Then = std::function<void(EditorContext&)>;

/// The user's own document: what a lesson has set aside, else the one that is open.
const Document& user_document(const EditorContext& context);

/// Does it at once when nothing would be lost; else asks: save first, discard, or leave all as it is. In a lesson
/// nothing of the lesson is asked for; when what was set aside has unsaved changes, the lesson is left instead, so that it is seen.
void unless_unsaved(EditorContext& context, const std::string& doing, Then then);

/// Into the project's file; asks for a name when it has none. `then`: once it is on the disk.
void save_project(EditorContext& context, Then then = {});
void save_project_as(EditorContext& context, Then then = {});

/// An empty scene with the start page in front.
void new_project(EditorContext& context);
/// Asks for a file.
void choose_project(EditorContext& context);
void open_project(EditorContext& context, const std::filesystem::path& path);
void open_embedded_scene(EditorContext& context, const std::string& name);
/// Asks nothing.
void open_empty_scene(EditorContext& context, bool start_page);
void quit(EditorContext& context);

/// A scene with nothing in it.
Scene empty_scene();
/// Name for a file that does not exist yet: the project's own, else one made from the scene's name in the current folder.
std::filesystem::path suggested_file(const EditorContext& context);

} // namespace fascicle::editor
