#include "fascicle/anatomy/outline_bone.hpp"

#include "fascicle/base/assert.hpp"

#include <limits>

namespace fascicle {

OutlineBone find_outline_bone(const AttachmentOutline& outline, const std::vector<std::string>& names,
                              const std::vector<DistanceToBone>& distances, double on_surface, double far) {
    FASCICLE_ASSERT(names.size() == distances.size());
    OutlineBone best;
    best.mean_distance = std::numeric_limits<double>::infinity();
    for (std::size_t b = 0; b < names.size() && !outline.points.empty(); ++b) {
        double sum = 0;
        for (const Vec3& p : outline.points)
            sum += distances[b](p, far);
        const double mean = sum / double(outline.points.size());
        const bool named = names[b] == outline.bone;
        if (named || mean < best.mean_distance)
            best = {static_cast<int>(b), mean <= on_surface, mean};
        if (named)
            break;
    }
    return best;
}

} // namespace fascicle
