#include "fascicle/anatomy/wrap_surface.hpp"

namespace fascicle {

WrapContact wrap_segment(const WrapSurface& surface, const Vec3& p, const Vec3& q, std::vector<Vec3>* curve) {
    if (curve != nullptr)
        curve->clear();
    if (!p.allFinite() || !q.allFinite())
        return {};
    switch (surface.shape) {
    case WrapShape::sphere:
        return wrap_sphere(surface, p, q, curve);
    case WrapShape::cylinder:
        return wrap_cylinder(surface, p, q, curve);
    case WrapShape::ellipsoid:
        return wrap_ellipsoid(surface, p, q, curve);
    case WrapShape::torus:
        break;
    }
    return {};
}

} // namespace fascicle
