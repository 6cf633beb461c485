#pragma once
// Names that OpenSim takes: components are addressed by paths of them.

#include <set>
#include <string>
#include <string_view>

namespace fascicle::io {

/// Letters, digits, '_', '-' and '.' of ASCII stay; each other character (of UTF-8, or a byte that is none) becomes '_'. OpenSim itself
/// only refuses white space and / \ * + (ComponentPath::getInvalidChars), but files with other letters break on the way through
/// tools that take the file for ASCII. Never empty, never begins with '.' or '-': `otherwise` is put there.
std::string osim_name(std::string_view name, std::string_view otherwise);

/// Names that are given out once: "femur", "femur_2", "femur_3".
class OsimNames {
public:
    explicit OsimNames(std::set<std::string> taken = {}) : taken_(std::move(taken)) {}
    std::string unique(std::string name);

private:
    std::set<std::string> taken_;
};

} // namespace fascicle::io
