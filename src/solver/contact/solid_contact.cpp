#include "solver/contact/solid_contact.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::solver {

namespace {

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
            const double squared_norm = sample.gradient.squaredNorm();
            if (squared_norm < 1e-6) { // a ridge of the field, or saturated: no direction
                result.outside = result.outside && sample.value > 0.5 * settings.offset;
                continue;
            }
            const Vec3 gradient = solid.now.rotation * sample.gradient;
            x += depth / squared_norm * gradient;
            moved = true;
            result.outside = result.outside && depth < 0.5 * settings.offset;
            if (settings.friction > 0.0 && pass == 0) {
                const double normal_correction = depth / std::sqrt(squared_norm);
                const Vec3 slip = tangential_slip(x, before, solid, gradient / std::sqrt(squared_norm));
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
