#pragma once
// Which bone of a scene a digitised outline belongs to: names in files need not be those of the scene.

#include "fascicle/anatomy/attach.hpp"

namespace fascicle {

/// bone: index, -1 without bones or points. on_bone: whether the outline lies on it.
struct OutlineBone {
    int bone = -1;
    bool on_bone = false;
    double mean_distance = 0; ///< of the points, scene units
};

/// The bone of the outline's name, else the nearest one in the mean over the points. names and distances: one entry per
/// bone. on_surface: largest mean distance of an outline on its bone, far: any distance beyond it counts as infinite (both in
/// scene units).
OutlineBone find_outline_bone(const AttachmentOutline& outline, const std::vector<std::string>& names,
                              const std::vector<DistanceToBone>& distances, double on_surface, double far);

} // namespace fascicle
