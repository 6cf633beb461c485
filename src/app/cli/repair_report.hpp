#pragma once
// What `fascicle repair` tells of its work: a table for people, JSON for programs.

#include "fascicle/geometry/repair/repair.hpp"

#include <iosfwd>

namespace fascicle::app {

struct RepairReport {
    std::string in, out;
    std::string unit; ///< "mm" or "m"
    bool unit_guessed = false;
    RepairOptions options; ///< in units of the mesh
    int arrays = 0;        ///< per point, carried over
    std::vector<std::string> notes;
};

/// Found and done, left, and a table of before and after.
void print(std::ostream& out, const RepairReport& report, const RepairResult& result);
/// Keys: docs/cli.md, "repair".
std::string to_json(const RepairReport& report, const RepairResult& result);

} // namespace fascicle::app
