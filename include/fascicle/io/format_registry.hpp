#pragma once
// The mesh formats: one row each. A new format is a pair in src/io/formats/, a row here, samples and a round
// trip.

#include "fascicle/io/mesh_data.hpp"

#include <filesystem>
#include <functional>
#include <ostream>
#include <string_view>

namespace fascicle {

struct MeshFormat {
    std::string name;                    ///< shown to people
    std::vector<std::string> extensions; ///< lower case, with the dot; the first is the usual one
    /// Whether the bytes look like this format, whatever the file is called.
    std::function<bool(std::string_view bytes)> recognises;
    /// Error naming `file` and the line or byte.
    std::function<MeshData(std::string_view bytes, const std::string& file)> read;
    /// Writes what the format can hold (arrays are dropped where it cannot); null when only reading is known.
    std::function<void(std::ostream& out, const MeshData& data)> write;
};

const std::vector<MeshFormat>& mesh_formats();

/// Format of the bytes: by content, and where nothing recognises them, by the file's extension; null when
/// neither tells.
const MeshFormat* recognise_format(std::string_view bytes, const std::filesystem::path& file);

/// Format to write a file in, by its extension. Error (usage) naming the known ones.
const MeshFormat& format_for_writing(const std::filesystem::path& file);

} // namespace fascicle
