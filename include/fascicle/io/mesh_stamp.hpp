#pragma once
// What a mesh file says about itself, as writers put it where find_mesh_hints looks: comments, titles, headers, FieldData.

#include "fascicle/io/format_registry.hpp"
#include "fascicle/io/mesh_hints.hpp"
#include "fascicle/scene/scene.hpp"

namespace fascicle {

/// Unit and frame of coordinates, and the axis that points up ('y' or 'z'); nothing where it is not known.
struct MeshStamp {
    MeshHints hints;
    std::optional<char> up;
    bool empty() const { return hints == MeshHints{} && !up; }
};

/// All that a file says: find_mesh_hints and find_up_axis. Nothing is guessed.
MeshStamp find_mesh_stamp(std::string_view bytes);
/// The same of a file; nothing when it cannot be read.
MeshStamp read_mesh_stamp(const std::filesystem::path& path);
/// 'y' or 'z' where the file names it: glTF (always y), `upAxis` of USD, "up y" in comments, titles and FieldData.
std::optional<char> find_up_axis(std::string_view bytes);

/// Writes the mesh and what is known of its coordinates, as far as the format has a place for it. Error as of format.write.
void write_stamped(std::ostream& out, const MeshFormat& format, const MeshData& data, const MeshStamp& stamp);

/// The same as a file, complete or not there.
void write_stamped_file(const std::filesystem::path& path, const MeshData& data, const MeshStamp& stamp);
/// Coordinates of a scene: its unit. Its frame is not known to the program: no SPACE is claimed.
MeshStamp stamp_of(LengthUnit unit);

/// A sentence for each thing that files of the format cannot say.
std::vector<std::string> lost_of_stamp(const MeshFormat& format, const MeshStamp& stamp);

/// "LPS" or "RAS".
const char* to_text(MeshSpace space);

} // namespace fascicle
