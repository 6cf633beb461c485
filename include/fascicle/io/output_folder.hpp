#pragma once
// No output replaces an input.

#include "fascicle/scene/scene.hpp"

#include <filesystem>
#include <set>
#include <vector>

namespace fascicle {

/// Every file that the scene was read from.
std::set<std::filesystem::path> inputs_of(const Scene& scene);

/// Error unless the names of all bones and muscles call files of their own (file_name_for).
void require_file_names(const Scene& scene);

/// The folder, once it is clear that no file that `simulate` or `fibres` leaves there would replace an input of the scene, and their names
/// are as require_file_names wants them; else Error (usage) naming the input.
const std::filesystem::path& without_inputs(const std::filesystem::path& folder, const Scene& scene,
                                            const std::vector<std::filesystem::path>& more_inputs = {});

} // namespace fascicle
