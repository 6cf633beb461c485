#include "solver/contact/solid_contact.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::solver {

namespace {

/// Below this length the gradient of a distance (1 where it is exact) says nothing about the way out.
constexpr double min_gradient = 0.3;

/// Slip of x along the surface of a solid since the start of the substep.
Vec3 tangential_slip(const Vec3& x, const Vec3& before, const ContactSolid& solid, const Vec3& normal) {
    const Vec3 carried = solid.now.apply(solid.before.apply_inverse(before));
    const Vec3 slip = x - carried;
    return slip - slip.dot(normal) * normal;
}

} // namespace

ContactResult resolve_contact(Vec3& x, const Vec3& before, std::span<const ContactSolid> solids,
                              const ContactSettings& settings) {
    ContactResult result;
    for (int pass = 0; pass < settings.passes; ++pass) {
        bool moved = false;
        result.outside = true;
        for (const ContactSolid& solid : solids) {
            const DistanceSample sample = solid.grid->sample(solid.now.apply_inverse(x));
            const double depth = settings.offset - sample.value;
            if (depth <= 0.0)
                continue;
            const double norm = sample.gradient.norm();
            if (norm < min_gradient) {
                // Deep inside, or on a ridge of the field: no direction to trust. The point was outside at the start of
                // the substep, so where the solid would have carried it from there is outside of this solid.
                x = solid.now.apply(solid.before.apply_inverse(before));
                moved = true;
                result.outside =
                    result.outside && solid.grid->value(solid.before.apply_inverse(before)) > 0.0;
                continue;
            }
            const Vec3 normal = solid.now.rotation * sample.gradient / norm;
            x += depth / norm * normal;
            result.normal = normal;
            moved = true;
            result.outside = result.outside && depth < 0.5 * settings.offset;
            if (settings.friction > 0.0 && pass == 0) {
                const double normal_correction = depth / norm;
                const Vec3 slip = tangential_slip(x, before, solid, normal);
                const double length = slip.norm();
                if (length > 0.0)
                    x -= std::min(1.0, settings.friction * normal_correction / length) * slip;
            }
        }
        result.touched = result.touched || moved;
        if (!moved)
            break;
    }
    return result;
}

} // namespace fascicle::solver
