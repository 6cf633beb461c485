#pragma once
// No output replaces an input.

#include "fascicle/scene/scene.hpp"

#include <filesystem>

namespace fascicle {

/// The folder, once it is clear that no file that `simulate` or `fibres` leaves there would replace an input of the scene; else Error
/// (usage) naming the input.
const std::filesystem::path& without_inputs(const std::filesystem::path& folder, const Scene& scene);

/// Error (usage) naming the input when one of the files is an input of the scene.
void refuse_inputs(const std::vector<std::filesystem::path>& files, const Scene& scene);

} // namespace fascicle
