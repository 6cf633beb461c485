#include "fascicle/io/mesh_file.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/base/state_hash.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/format_registry.hpp"
#include "fascicle/io/mesh_convert.hpp"

namespace fascicle {

namespace {

std::string_view without_mark(std::string_view bytes) {
    if (bytes.substr(0, 3) == "\xef\xbb\xbf") // UTF-8 byte order mark
        bytes.remove_prefix(3);
    return bytes;
}

const MeshFormat& format_of(std::string_view bytes, const std::string& name) {
    const std::string_view content = without_mark(bytes);
    const MeshFormat* format = recognise_format(content, name);
    if (format == nullptr)
        throw_error(name, content.empty() ? "the file is empty" : "the file is of no known format",
                    mesh_format_names());
    return *format;
}

MeshData read_as(const MeshFormat& format, std::string_view bytes, const std::string& name) {
    MeshData data = format.read(without_mark(bytes), name);
    if (data.mesh.positions.empty() && data.lines.points.empty())
        throw_error(name, "the file holds no points", "a mesh");
    return data;
}

} // namespace

MeshData read_mesh_data(std::string_view bytes, const std::string& name, const MeshFormat** found) {
    const MeshFormat& format = format_of(bytes, name);
    if (found != nullptr)
        *found = &format;
    return read_as(format, bytes, name);
}

MeshData read_mesh_data(const std::filesystem::path& path) {
    return read_mesh_data(read_file(path), path.string());
}

MeshFile read_mesh_bytes(std::string_view bytes, const std::string& name, const MeshFormat& format) {
    MeshData data = read_as(format, bytes, name);
    MeshFile file;
    file.lines = std::move(data.lines);
    file.format = format.name;
    file.notes = std::move(data.notes);
    file.point_arrays = std::move(data.point_arrays);
    file.line_arrays = std::move(data.line_arrays);
    StateHash hash;
    hash.add_bytes(bytes.data(), bytes.size());
    file.hash = hash.hex();
    MendedMesh mended = mend(std::move(data.mesh));
    if (!mended.report.usable()) // the readers name the line; this is the net below them
        require_bone_surface(mended.report, name);
    file.mesh = std::move(mended.mesh);
    file.report = mended.report;
    return file;
}

MeshFile read_mesh_bytes(std::string_view bytes, const std::string& name) {
    return read_mesh_bytes(bytes, name, format_of(bytes, name));
}

MeshFile read_mesh_file(const std::filesystem::path& path) {
    const std::string bytes = read_file(path);
    return read_mesh_bytes(bytes, path.string());
}

void write_mesh_file(const std::filesystem::path& path, const MeshData& data) {
    const MeshFormat& format = format_for_writing(path);
    AtomicFile file(path);
    format.write(file.stream(), data);
    file.commit();
}

} // namespace fascicle
