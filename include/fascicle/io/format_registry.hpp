#pragma once
// The mesh formats: one row each. A new format is a pair in src/io/formats/, a row here, samples and a round
// trip.

#include "fascicle/io/mesh_data.hpp"

#include <filesystem>
#include <functional>
#include <ostream>
#include <string_view>

namespace fascicle {

/// What files of a format can hold beside the triangles.
struct MeshFormatHolds {
    bool point_arrays = false; ///< of any name and number of components
    bool colours = false; ///< where not: point arrays "Normals" (3), "RGB" (3) and "RGBA" (4) all the same
    bool lines = false;
    bool long_lines = true;   ///< lines of more than two points stay one
    bool line_arrays = false; ///< when there are no triangles
    bool doubles = true;      ///< coordinates to the last bit; else as float
    bool vertex_order = true; ///< also vertices that no triangle uses
    bool metres = false;      ///< files of the format say that they are in metres, whatever is written
};

struct MeshFormat {
    std::string name;                    ///< shown to people
    std::vector<std::string> extensions; ///< lower case, with the dot; the first is the usual one
    /// Whether the bytes look like this format, whatever the file is called.
    std::function<bool(std::string_view bytes)> recognises;
    /// Error naming `file` and the line or byte.
    std::function<MeshData(std::string_view bytes, const std::string& file)> read;
    /// Writes what the format can hold (arrays are dropped where it cannot); null when only reading is known.
    std::function<void(std::ostream& out, const MeshData& data)> write;
    MeshFormatHolds holds = {};
};

const std::vector<MeshFormat>& mesh_formats();

/// Format of the bytes: by content, and where nothing recognises them, by the file's extension; null when
/// neither tells.
const MeshFormat* recognise_format(std::string_view bytes, const std::filesystem::path& file);

/// The same of a file, of which only the beginning is read; null also when it cannot be read.
const MeshFormat* recognise_file(const std::filesystem::path& file);

/// Extensions of all formats, lower case, with the dot.
std::vector<std::string> mesh_extensions();
/// "OBJ, STL, PLY": the names of all formats.
std::string mesh_format_names();

/// Format to write a file in, by its extension. Error (usage) naming the known ones.
const MeshFormat& format_for_writing(const std::filesystem::path& file);

} // namespace fascicle
