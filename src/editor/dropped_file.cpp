#include "editor/dropped_file.hpp"

#include "fascicle/io/csv.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/format_registry.hpp"

#include <algorithm>

namespace fascicle::editor {

namespace fs = std::filesystem;

namespace {

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return text;
}

/// By the columns of its header row.
FileKind kind_of_table(const std::string& head, const fs::path& path, std::string& why) {
    try {
        const CsvReader csv(head, path.filename().string());
        std::vector<std::string> names;
        for (const std::string& name : csv.columns())
            names.push_back(plain_column(name));
        const auto has = [&](const char* name) {
            return std::find(names.begin(), names.end(), name) != names.end();
        };
        if (has("attachment"))
            return FileKind::outlines;
        if (has("frame") && has("bone"))
            return FileKind::motion;
    } catch (const std::exception&) { // no table at all
    }
    why = path.filename().string() + ": a table of another kind; expected columns attachment,bone,x,y,z "
                                     "(outlines) or frame,bone,... (a motion)";
    return FileKind::unknown;
}

bool is_mesh_extension(const std::string& extension) {
    const std::vector<std::string> known = mesh_extensions();
    return std::find(known.begin(), known.end(), extension) != known.end();
}

} // namespace

FileKind kind_of_file(const fs::path& path, std::string& why) {
    const std::string extension = lower(path.extension().string());
    if (extension == ".fascicle")
        return FileKind::project;
    if (extension == ".osim")
        return FileKind::model;
    if (extension == ".mot" || extension == ".sto")
        return FileKind::storage;
    if (extension == ".json")
        return FileKind::fibre_template;
    if (is_mesh_extension(extension))
        return FileKind::mesh;
    const std::string head = read_head(path, std::size_t{1} << 16);
    if (extension == ".csv" || extension == ".tsv")
        return kind_of_table(head, path, why);
    if (head.find("<OpenSimDocument") != std::string::npos)
        return FileKind::model;
    if (recognise_file(path) != nullptr)
        return FileKind::mesh;
    if (lower(head).find("\nendheader") != std::string::npos)
        return FileKind::storage;
    why =
        path.filename().string() +
        ": no file that can be put into a scene; expected a mesh, a project, attachment outlines or a motion "
        "(.csv), .mot or .sto, .osim, or a fibre template (.json)";
    return FileKind::unknown;
}

} // namespace fascicle::editor
