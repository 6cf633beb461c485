#pragma once
// What the export dialog tells of a choice before it is made.

#include "editor/editor_context.hpp"
#include "output/export_kinds.hpp"

namespace fascicle::editor {

/// Why the kind cannot be exported now, as the end of a sentence; empty when it can.
std::string reason_against(const EditorContext& context, std::string_view kind);
/// Number of the last frame of the run that is shown; 0 before any.
int last_exported_frame(const EditorContext& context);
/// Which frames there are, and whether more will come.
std::string frames_text(const EditorContext& context);
/// Number of pictures or files, and about how much space they take.
std::string estimate_text(const EditorContext& context, const output::ExportRequest& request, int pictures,
                          int width, int height);
/// "pictures/s: 12.0 s, half the speed of the motion".
std::string speed_text(const EditorContext& context, int pictures, const output::ExportRequest& request);
/// What exists under the name already; empty when nothing does.
std::string replace_warning(const std::filesystem::path& target, std::string_view kind);
/// The scene's name as one that every file system takes.
std::string export_name(const std::string& scene);
/// As much of the text's end as fits, after an ellipsis.
std::string elided_front(const std::string& text, float width);

} // namespace fascicle::editor
