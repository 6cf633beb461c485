#pragma once
// Mesh files in and out, whatever their format.

#include "fascicle/geometry/mesh_check.hpp"
#include "fascicle/io/format_registry.hpp"

#include <filesystem>
#include <string_view>

namespace fascicle {

/// A mesh file, read and mended.
struct MeshFile {
    TriMesh mesh;    ///< mended; vertices and their order as in the file
    Polylines lines; ///< as in the file
    MeshReport report;
    std::string format;             ///< MeshFormat::name
    std::string hash;               ///< StateHash of the file's bytes
    std::vector<std::string> notes; ///< what the reader says; report.lines() says the rest
    std::vector<NamedArray> point_arrays, line_arrays;
};

/// Reads by content, not only by extension. Error naming the file and the place: no such file, unknown
/// format, bad numbers or indices, coordinates that are not finite, neither points nor cells.
MeshFile read_mesh_file(const std::filesystem::path& path);

/// The same for bytes in memory; `name` stands for the file in messages, its extension counts.
MeshFile read_mesh_bytes(std::string_view bytes, const std::string& name);
/// The same in a format that the caller knows.
MeshFile read_mesh_bytes(std::string_view bytes, const std::string& name, const MeshFormat& format);

/// What a file holds, with all its defects. Error as read_mesh_file, but that of a file without points.
MeshData read_mesh_data(const std::filesystem::path& path);

/// Writes in the format of the extension; the file is complete or not there. Error when it cannot be written.
void write_mesh_file(const std::filesystem::path& path, const MeshData& data);

} // namespace fascicle
