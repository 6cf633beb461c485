#pragma once
// The orbit camera of the viewport: a pivot, a distance, two angles. A plain value: copies are the camera slots.

#include "fascicle/geometry/bounding_box.hpp"
#include "render/draw_list.hpp"

#include <optional>

namespace fascicle::view {

/// Which way is up, and with it the whole anatomical frame: `lps` has +x left, +y posterior, +z superior (medical
/// images); `y_up` has +x anterior, +y superior, +z right (OpenSim, ISB).
enum class WorldAxes { lps, y_up };

/// Anatomical directions as unit vectors in scene coordinates; left = superior x anterior.
struct AnatomicalFrame {
    Vec3 anterior, left, superior;
};
AnatomicalFrame anatomical_frame(WorldAxes axes);

/// Where the eye is: `anterior` looks at the front, with the left side of the body on the right of the picture.
/// `superior` and `inferior` have anterior at the top.
enum class StandardView { anterior, posterior, left, right, superior, inferior };

struct Ray {
    Vec3 origin = Vec3::Zero();
    Vec3 direction = Vec3::UnitX(); ///< unit length, away from the eye
};

/// Size of the picture the camera fills. Pixel coordinates run from the top left corner, y down; the middle of the first
/// pixel is (0.5, 0.5).
struct ViewSize {
    double width = 1;
    double height = 1;
    double aspect() const { return width / height; }
};

class Camera {
public:
    explicit Camera(WorldAxes axes = WorldAxes::lps);

    // Moves. Pixel amounts are pointer moves: the scene follows the pointer.
    /// A drag over the picture's height turns by half a turn; pitch stops at straight up and down.
    void orbit(double dx_px, double dy_px, const ViewSize& size);
    /// Turns by angles: positive yaw moves the eye towards the right of the picture, positive pitch upwards.
    void orbit_by(double yaw_rad, double pitch_rad);
    /// Points at the pivot's depth stay under the pointer.
    void pan(double dx_px, double dy_px, const ViewSize& size);
    /// Multiplies the distance by `factor` > 0 (below 1: nearer); the point of the pivot's plane under (x, y) stays put.
    void zoom(double factor, double x_px, double y_px, const ViewSize& size);
    void look_from(StandardView standard);
    /// Keeps the eye and turns the view to `pivot` (double-click on a surface).
    void set_pivot(const Vec3& pivot);
    /// Moves pivot and distance so that the points just fill the picture at the present angles, with a border of 4 %.
    /// No points: left alone; a single place is shown with a border of the scene's size, or of 1 unit.
    void frame(const Points& points, double aspect);
    /// The same for a box's corners; an empty box is left alone.
    void frame(const BoundingBox& box, double aspect);
    /// What may be seen at all: near and far planes follow it. Call when the scene's extent changes.
    void set_scene_bounds(const BoundingBox& box);

    void set_orthographic(bool on) { orthographic_ = on; }
    bool orthographic() const { return orthographic_; }
    /// Full vertical angle of view in degrees, kept within 5 to 120.
    void set_fov_deg(double fov_deg);
    double fov_deg() const;
    WorldAxes axes() const { return axes_; }
    /// Changes the anatomical frame, keeping yaw, pitch and pivot.
    void set_axes(WorldAxes axes) { axes_ = axes; }

    const Vec3& pivot() const { return pivot_; }
    double distance() const { return distance_; }
    double yaw_rad() const { return yaw_; }
    double pitch_rad() const { return pitch_; }
    Vec3 eye() const { return pivot_ + distance_ * backward(); }
    /// Unit vectors of the picture: to its right, to its top, and from the pivot to the eye.
    Vec3 right() const;
    Vec3 up() const;
    Vec3 backward() const;
    /// Scene units a pixel covers at the pivot's depth.
    double units_per_pixel(const ViewSize& size) const;

    render::CameraPose pose(double aspect) const;
    /// The ray from the eye (orthographic: from the eye's plane) through a place of the picture, for picking.
    Ray ray(double x_px, double y_px, const ViewSize& size) const;
    /// Where a point appears, in pixels; nothing when it is behind the eye (perspective only).
    std::optional<Vec2> project(const Vec3& point, const ViewSize& size) const;

private:
    double half_height() const; ///< of the view at distance 1
    void clip_range(double& near_plane, double& far_plane) const;

    WorldAxes axes_;
    Vec3 pivot_ = Vec3::Zero();
    double distance_ = 3.0;
    double yaw_ = 0.0;   ///< 0: eye in front, pi/2: eye at the left side
    double pitch_ = 0.0; ///< -pi/2 (below) to pi/2 (above)
    double fov_rad_;
    bool orthographic_ = false;
    Vec3 scene_centre_ = Vec3::Zero();
    double scene_radius_ = 0.0; ///< 0: unknown
};

} // namespace fascicle::view
