#pragma once
// A thin curved sheet of varying thickness with a free outline: bone plates, flat muscles.

#include "fascicle/geometry/implicit.hpp"

#include <vector>

namespace fascicle {

/// A place the middle surface of the sheet passes through, and half the thickness there (> 0).
struct SheetStation {
    Vec3 point;
    double half_thickness;
};

/// The plane the sheet is a height function over: u and v are unit and perpendicular, heights are along u x
/// v.
struct SheetPlane {
    Vec3 origin, u, v;
};

/// The sheet: heights and half thicknesses are thin-plate splines (J. Duchon 1977, kernel r^2 log r plus a
/// plane) through all stations; the outline is the closed Catmull-Rom curve through the outline stations (at
/// least 3, in order, not crossing itself in the plane). The rim is rounded with the half thickness there and
/// lies inside the outline. Stations must have different places in the plane. The value is hypot(max(e + t,
/// 0), d) - t with e the signed distance to the outline in the plane, d the height over the middle surface
/// divided by sqrt(1 + slope^2), t the half thickness: first-order exact on gentle slopes. Splines and
/// outline are tabulated every `table_step`.
ImplicitShape sheet_shape(const SheetPlane& plane, const std::vector<SheetStation>& outline,
                          const std::vector<SheetStation>& inside, double table_step = 1.5);

} // namespace fascicle
