#pragma once
// Which vertices a paint tool touches at a place, and which of them would change.

#include "editor/paint/paint_settings.hpp"
#include "editor/paint/paint_view.hpp"
#include "fascicle/document/actions/area_actions.hpp"

namespace fascicle::editor {

/// A tool held at a place of a bone. Positions in the bone's coordinates.
struct PaintAim {
    SurfacePoint at;
    Vec2 pointer = Vec2::Zero(); ///< pixels of the view
    double radius = 0;           ///< scene units, > 0
    double radius_px = 0;        ///< the same at that depth
};

/// radius at a place of the bone, from the settings. scale: of the interface.
PaintAim paint_aim(const PaintSettings& settings, const PaintView& view, const SurfacePoint& at,
                   const Vec2& pointer, double unit_mm, double scale);

/// The brush of the two projections that follow the surface.
Brush paint_brush(const PaintSettings& settings, const PaintView& view, const PaintAim& aim);

/// Vertices under the circle on its way between two places of the screen (the same for a click), ascending.
std::vector<int> under_screen_circle(const SurfaceGraph& graph, const PaintSettings& settings,
                                     const PaintView& view, const Vec2& from, const PaintAim& to);

/// Fills, kept until something else is pointed at: a fill of the whole bone must not be made for every move of the pointer.
class PaintFills {
public:
    /// areas: the muscle's on this bone, all labels: what a bucket's border consists of. area: the label's own, or null.
    const std::vector<int>& smart(const SurfaceGraph& graph, int triangle, double crease_rad);
    const std::vector<int>& bucket(const SurfaceGraph& graph, const SurfaceRegion* area,
                                   const SurfaceRegion& all_areas, int vertex, bool erase);
    void forget() { *this = {}; }

private:
    const SurfaceGraph* graph_ = nullptr;
    int kind_ = 0; ///< 1 smart, 2 bucket, 3 bucket as an eraser
    double crease_ = 0;
    SurfaceRegion barrier_, filled_;
    std::vector<int> vertices_;
};

/// Of the touched vertices those that a stroke would change.
std::vector<int> would_change(const Scene& scene, const SurfaceGraph& graph, const actions::AreaKey& key,
                              actions::StrokeMode mode, const std::vector<actions::AreaKey>& locked,
                              std::vector<int> touched);

/// The cursor: segments of a circle on the surface round the point, two points each. Where the brush follows the surface it
/// is the line of equal distance along it, else the straight circle laid onto the surface.
Points cursor_ring(GeodesicSearch& search, const SurfacePoint& at, const Brush& brush);

} // namespace fascicle::editor
