#pragma once
// From the unit cube of a template to a muscle: each cross-section onto the isolines of one level.

#include "anatomy/fibres/isolines.hpp"

namespace fascicle {

/// How the cube lies: unit axes along its x (across), y (from origin to insertion) and z (depth). Right-handed, or
/// mirrored.
struct TemplateFrame {
    Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
};

/// Levels c = 0..N of the field at (almost) c / N. Each has one loop, or several (heads), which then share the rectangle
/// in strips by the areas that they enclose. Loops start and run so that neighbouring levels twist least.
class ContourMap {
public:
    static constexpr std::size_t loop_points = 96;

    ContourMap(const TriMesh& mesh, const MeshTopology& topology, const std::vector<double>& field,
               int levels, const TemplateFrame& frame);

    /// Image of (x, y, z) in the cube: by mean value coordinates of the rectangle in the levels below and above y, and
    /// linearly between them.
    Vec3 operator()(const Vec3& cube) const;
    int most_loops() const { return most_loops_; }
    int empty_levels() const { return empty_levels_; }

private:
    /// One loop with the piece of the unit square that is mapped on it.
    struct Strip {
        double low = 0, high = 1;    ///< of the coordinate that is shared
        Points contour;              ///< loop_points, from corner (0, 0) by (1, 0), (1, 1), (0, 1)
        std::vector<Vec2> rectangle; ///< the same points on the border of [0, width] x [0, depth]
        Vec2 size = Vec2::Ones();    ///< width and depth
    };
    struct Level {
        int axis = 0; ///< 0: strips share x; 1: z
        std::vector<Strip> strips;
        Vec3 x, z; ///< the frame carried along
    };
    struct Loop;

    Vec3 at(const Level& level, double x, double z) const;
    Level make_level(const std::vector<Loop>& loops, const Level* beside, const TemplateFrame& frame) const;
    Strip make_strip(const Loop& loop, double low, double high, int axis, const Level& level,
                     const Level* beside) const;

    std::vector<Level> levels_;
    bool mirrored_ = false;
    int most_loops_ = 0, empty_levels_ = 0;
};

} // namespace fascicle
