#pragma once
// Scenes that the program makes itself: no file is needed to try it.

#include "fascicle/scene/scene.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace fascicle {

struct EmbeddedSceneInfo {
    std::string name;
    std::string line; ///< what it shows, one line
};

/// All embedded scenes, in the order they are listed to users.
const std::vector<EmbeddedSceneInfo>& embedded_scenes();

/// Makes the scene; the same bits on every call. Throws Error (usage) with the known names when there is none of
/// that name. `threads` only says how many may help; it changes nothing in the result.
Scene make_embedded_scene(std::string_view name, int threads = 1);

/// The `cylinder` scene in closed form. A strap (muscle) comes down in front of a fixed cylinder of radius
/// `cylinder_radius` whose axis is the hinge (x axis through the origin), wraps its underside and leaves backwards to
/// a block that turns about the hinge by theta. Straight parts of length `straight_length` at both ends are tangent to
/// the cylinder and turn rigidly with what they are fixed to, so only the wrap changes: for a fibre at `offset` from
/// the middle surface of the strap (positive away from the cylinder) the radius is
///     r = cylinder_radius + clearance + thickness / 2 + offset,
/// the length L(theta) = 2 straight_length + r (pi / 2 + theta), the moment arm dL/dtheta = r.
/// Valid while the strap touches the cylinder, theta > -pi / 2, and as long as it keeps its thickness. A body that keeps
/// its volume does not: stretched by lambda it thins to between 1 / lambda and 1 / sqrt(lambda), and r (pi / 2 + theta)
/// shortens by up to (thickness / 2) (1 - 1 / lambda) (pi / 2 + theta). So the strap is long and thin: lambda is at most
/// 1.10, and that shortening at most 0.32 mm of the 17.3 mm that L grows by (1.9 %).
/// Lengths in mm, angles in rad, right-hand rule about +x; theta = 0 is rest.
struct CylinderScene {
    static constexpr double cylinder_radius = 20.0;
    static constexpr double clearance =
        0.12; ///< between strap and cylinder at rest, about what contact keeps
    static constexpr double thickness = 3.0;
    static constexpr double width = 24.0;
    static constexpr double straight_length = 70.0;
    static constexpr double attached_length = 10.0; ///< of the strap at each end, fixed through its thickness
    static constexpr double angle_rad = 0.8;        ///< greatest angle of the scene's motion
};
double cylinder_moment_arm(double offset = 0.0);
double cylinder_path_length(double angle_rad, double offset = 0.0);

} // namespace fascicle
