#pragma once
// Presets: named sets of parameter values as files, those that come with the program and a user's own. docs/formats.md
// describes them.

#include "fascicle/base/param_table.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fascicle {

struct Preset {
    std::string key;     ///< short, as `--preset` takes it
    std::string label;   ///< shown to people
    std::string meaning; ///< what it is for
    /// Parameter keys and values as ParamSet::set_text reads them, in the file's order. What is not named stays as it is.
    std::vector<std::pair<std::string, std::string>> values;
    std::filesystem::path file; ///< of a user's own; empty: comes with the program
};

/// From JSON. Error naming file and field when the text is no such file, or a value is none of its parameter's. Without a
/// key the file's name serves, without a label the key.
Preset parse_preset(std::string_view bytes, const std::string& file);
/// The same from a file of at most 1 MB.
Preset read_preset(const std::filesystem::path& path);
/// Written whole or not at all. Error naming the file.
void write_preset(const std::filesystem::path& path, const Preset& preset);
/// What would be written.
std::string preset_text(const Preset& preset);

/// Those of resources/presets: paper, soft, stiff, isotropic. They are part of the program.
const std::vector<Preset>& built_in_presets();
/// Where a user's own presets are, below user_folder(); empty when that is.
std::filesystem::path presets_folder(const std::filesystem::path& user_folder);
/// The .json files of a folder, by name; none when there is no such folder. A bad one is left out with a line in problems.
std::vector<Preset> own_presets(const std::filesystem::path& folder, std::vector<std::string>& problems);

/// What `--preset` names: a built-in preset's key, else one of the user's own (in `folder`, which may be empty), else a
/// path. Error (usage) naming the keys when it is none of them.
Preset find_preset(const std::string& key_or_path, const std::filesystem::path& folder);

/// The edited values of a set, and its method, as a preset.
Preset preset_of(const ParamSet& parameters, const std::string& label);

/// Sets the preset's values; of them solver.method first, with the defaults that it brings.
void apply_preset(const Preset& preset, ParamSet& parameters);

/// One line of what a preset would change.
struct PresetChange {
    std::string label, before, after; ///< values with their unit, short
};
std::vector<PresetChange> preset_changes(const Preset& preset, const ParamSet& parameters);

} // namespace fascicle
