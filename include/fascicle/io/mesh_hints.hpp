#pragma once
// What the header of a mesh file says about frame and unit, for people to be asked about: readers do not act on it.

#include <filesystem>
#include <optional>
#include <string_view>

namespace fascicle {

enum class MeshSpace { lps, ras };

struct MeshHints {
    std::optional<MeshSpace> space;    ///< "SPACE=LPS" or "SPACE=RAS", in any case
    std::optional<double> millimetres; ///< of one unit: "1 unit = 1000.000000 mm"
    friend bool operator==(const MeshHints&, const MeshHints&) = default;
};

/// Looks through the first 4 kB: STL headers, OBJ and PLY comments, VTK titles and the field SPACE, glTF, USD; and through the FieldData of
/// VTP, for which all bytes are needed where they are appended.
MeshHints find_mesh_hints(std::string_view bytes);
/// The same of a file; nothing when it cannot be read.
MeshHints read_mesh_hints(const std::filesystem::path& path);

} // namespace fascicle
