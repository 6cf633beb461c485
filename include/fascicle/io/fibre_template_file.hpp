#pragma once
// Fibre templates as files: the built-in ones, and a user's own. docs/formats.md describes them.

#include "fascicle/anatomy/fibre_template.hpp"
#include "fascicle/io/png.hpp"

#include <filesystem>
#include <string_view>

namespace fascicle {

/// A template from JSON. Error naming file and field (or line) when the text is no such file or check_template() finds a
/// fault. Without a key the file's name serves, without a label the key.
FibreTemplate parse_fibre_template(std::string_view bytes, const std::string& file);
/// The same from a file of at most 1 MB.
FibreTemplate read_fibre_template(const std::filesystem::path& path);

/// Those of resources/fibre_templates, in the order in which they are offered. They are part of the program: no file is
/// looked for when it runs.
const std::vector<FibreTemplate>& built_in_fibre_templates();

/// What `fibres.template` names: the key of a built-in template, else a path to a file. Error naming the keys when it is
/// neither.
FibreTemplate find_fibre_template(const std::string& key_or_path);

/// The template's curves in its cube, seen from the front and a little from above and the side; transparent behind.
/// size: pixels of a side, 16 to 4096.
PngImage draw_fibre_template(const FibreTemplate& fibre_template, int size);

} // namespace fascicle
