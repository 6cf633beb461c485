#pragma once
// ParaView's series of files over time (.pvd).

#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace fascicle::io {

/// Time and file of each step, files relative to the .pvd file.
void write_pvd(std::ostream& out, const std::vector<std::pair<double, std::string>>& series);

} // namespace fascicle::io
