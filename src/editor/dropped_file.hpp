#pragma once
// What a file is that was dropped on the window: by its extension, and where that does not tell, by what is in it.

#include <filesystem>
#include <string>

namespace fascicle::editor {

enum class FileKind { project, mesh, outlines, motion, storage, model, fibre_template, unknown };

/// Reads at most the beginning of the file. For a table of an unknown kind, and for anything unknown, `why` says in one
/// sentence what was expected. A file that cannot be read is what its extension says.
FileKind kind_of_file(const std::filesystem::path& path, std::string& why);

} // namespace fascicle::editor
