#pragma once
// Mesh files from one format into another: what stands in the file, nothing mended.

#include "fascicle/io/format_registry.hpp"

namespace fascicle {

/// What the bytes hold, as it stands there; `name` stands for the file in messages, its extension counts where the content does not
/// tell. found: the format, may be null. Error as of read_mesh_bytes.
MeshData read_mesh_data(std::string_view bytes, const std::string& name, const MeshFormat** found = nullptr);

/// Takes out what files of the format cannot hold. A sentence for each thing that is lost or changed.
std::vector<std::string> fit_to_format(MeshData& data, const MeshFormat& format);

} // namespace fascicle
