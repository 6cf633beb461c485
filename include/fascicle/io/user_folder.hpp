#pragma once
// Where a user's own things are kept: settings, recent projects, autosaves, presets.

#include <filesystem>

namespace fascicle {

/// $FASCICLE_USER when set (set to nothing: nothing is kept), else $XDG_DATA_HOME/fascicle, else ~/.local/share/fascicle.
/// Empty when there is no such place. The folder need not exist; whoever writes makes it.
std::filesystem::path user_folder();

} // namespace fascicle
