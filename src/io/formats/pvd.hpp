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

/// The same, read. Error naming file and line: no collection, a step without a file, a time that is no number.
std::vector<std::pair<double, std::string>> read_pvd(std::string_view bytes, const std::string& file);

bool looks_like_pvd(std::string_view bytes);

} // namespace fascicle::io
