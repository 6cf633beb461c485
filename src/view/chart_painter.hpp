#pragma once
// Lays a chart out on any kind of canvas, so that a vector picture and a pixel picture of it are the same.

#include "view/chart.hpp"
#include "view/decimate.hpp"

namespace fascicle::view {

/// Units: CSS pixels, y down.
class ChartCanvas {
public:
    enum class Anchor { start, middle, end };
    /// Kinds of lines that a reader of the file may look for.
    enum class Kind { curve, ghost };
    struct Stroke {
        render::Rgba colour{0, 0, 0, 1}; ///< alpha: opacity
        double width = 1;
        double dash = 0, gap = 0; ///< 0: solid
    };

    virtual ~ChartCanvas() = default;
    virtual void rectangle(double x, double y, double width, double height, const render::Rgba& fill) = 0;
    virtual void line(ScreenPoint from, ScreenPoint to, const Stroke& stroke) = 0;
    virtual void polyline(Kind kind, const std::vector<ScreenPoint>& points, const Stroke& stroke) = 0;
    /// Between an upper and a lower edge, both from the left.
    virtual void band(const std::vector<ScreenPoint>& upper, const std::vector<ScreenPoint>& lower,
                      const render::Rgba& fill) = 0;
    virtual void dot(ScreenPoint centre, double radius, const render::Rgba& fill) = 0;
    virtual void text(ScreenPoint baseline, double size, const std::string& text, Anchor anchor, bool bold,
                      const render::Rgba& fill) = 0;
    /// What follows is cut off outside of the rectangle, until unclip().
    virtual void clip(double x, double y, double width, double height) = 0;
    virtual void unclip() = 0;
};

/// width, height: at least 120 x 80; smaller ones count as that.
void paint_chart(ChartCanvas& canvas, const Chart& chart, int width, int height, bool dark);

} // namespace fascicle::view
