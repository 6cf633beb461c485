#pragma once
// From digitised outline points to the vertices of a bone.

#include "fascicle/geometry/geodesic_search.hpp"
#include "fascicle/geometry/surface_region.hpp"

#include <string>

namespace fascicle {

/// Lengths of the rules, all in scene units.
struct OutlineAreaRules {
    double mean_far = 3.0;  ///< an outline further from the bone in the mean is not on it
    double far = 15.0;      ///< neither is one with a point further away than this
    double open_gap = 15.0; ///< an outline whose ends are further apart is an open line (as in AttachRules)
    double strip = 2.0;     ///< width of the area along an open line
};

/// OutlineAreaRules for a scene whose unit is `unit_mm` millimetres.
OutlineAreaRules outline_area_rules(double unit_mm);

/// Projects the points to the nearest places of the bone and joins them by geodesic lines. A closed outline: the vertices on
/// its lines and all parts that the lines cut off from the rest of the bone's connected surface, but the largest part by
/// area: of a simple loop the smaller side. An open line, fewer than 3 points, or a loop that cuts nothing off: the vertices within half the
/// strip's width of the lines, and at least the nearest ones along them.
/// Error "who: ..." when there are no points, when the outline is far from the bone (mean_far, far), and when two neighbouring
/// points lie on parts of the bone that do not hang together. who: "gluteus_maximus: origin on 'sacrum'".
SurfaceRegion area_from_outline(GeodesicSearch& bone, const Points& outline, const OutlineAreaRules& rules,
                                const std::string& who);

} // namespace fascicle
