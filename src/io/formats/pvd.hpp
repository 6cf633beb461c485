#pragma once
// ParaView's series of files over time (.pvd).

#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fascicle::io {

/// Time and file of each step, files relative to the .pvd file.
void write_pvd(std::ostream& out, const std::vector<std::pair<double, std::string>>& series);

/// Time and file of each step. Files must lie in the folder of the .pvd or below it: Error (file and line), as for times that do not rise.
std::vector<std::pair<double, std::string>> read_pvd(std::string_view bytes, const std::string& file);

} // namespace fascicle::io
