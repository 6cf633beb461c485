#pragma once
// Names of bones and muscles: one set for both.

#include "fascicle/scene/scene.hpp"

namespace fascicle::actions {

inline bool taken(const Scene& scene, const std::string& name) {
    return scene.bone_index(name) >= 0 || scene.muscle_index(name) >= 0;
}

/// The wanted name (`otherwise` when it is empty), with a number behind it when it is taken.
inline std::string unique_name(const Scene& scene, const std::string& wanted, const char* otherwise) {
    const std::string base = wanted.empty() ? otherwise : wanted;
    std::string name = base;
    for (int number = 2; taken(scene, name); ++number)
        name = base + " " + std::to_string(number);
    return name;
}

} // namespace fascicle::actions
