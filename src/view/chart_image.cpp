#include "view/chart_image.hpp"

#include "fascicle/base/error.hpp"
#include "render/imgui_host.hpp"
#include "render/text_raster.hpp"
#include "view/chart_painter.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::view {

namespace {

using render::Rgba;

class PixelCanvas : public ChartCanvas {
public:
    PixelCanvas(int width, int height, double scale, const render::TextRaster& text,
                const render::TextRaster& bold)
        : scale_(scale), text_(text), bold_(bold) {
        image.width = static_cast<int>(std::lround(width * scale));
        image.height = static_cast<int>(std::lround(height * scale));
        image.rgba.assign(std::size_t(image.width) * std::size_t(image.height) * 4, 255);
        cover_.resize(std::size_t(image.width) * std::size_t(image.height));
        unclip();
    }

    void rectangle(double x, double y, double width, double height, const Rgba& fill) override {
        shape({{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}});
        paint(fill);
    }
    void line(ScreenPoint from, ScreenPoint to, const Stroke& stroke) override {
        stroke_line({from, to}, stroke);
    }
    void polyline(Kind, const std::vector<ScreenPoint>& points, const Stroke& stroke) override {
        stroke_line(points, stroke);
    }
    void band(const std::vector<ScreenPoint>& upper, const std::vector<ScreenPoint>& lower,
              const Rgba& fill) override {
        std::vector<ScreenPoint> outline = upper;
        outline.insert(outline.end(), lower.rbegin(), lower.rend());
        shape(outline);
        paint(fill);
    }
    void dot(ScreenPoint centre, double radius, const Rgba& fill) override {
        std::vector<ScreenPoint> circle;
        for (int i = 0; i < 24; ++i)
            circle.push_back({centre.x + radius * std::cos(i * 0.2617993878),
                              centre.y + radius * std::sin(i * 0.2617993878)});
        shape(circle);
        paint(fill);
    }
    void clip(double x, double y, double width, double height) override {
        clip_x0_ = std::max(0, static_cast<int>(std::floor(x * scale_)));
        clip_y0_ = std::max(0, static_cast<int>(std::floor(y * scale_)));
        clip_x1_ = std::min(image.width, static_cast<int>(std::ceil((x + width) * scale_)));
        clip_y1_ = std::min(image.height, static_cast<int>(std::ceil((y + height) * scale_)));
    }
    void unclip() override {
        clip_x0_ = clip_y0_ = 0;
        clip_x1_ = image.width;
        clip_y1_ = image.height;
    }
    void text(ScreenPoint at, double size, const std::string& what, Anchor anchor, bool bold,
              const Rgba& fill) override;

    render::Image image;

private:
    static constexpr int rows_per_pixel = 8;

    /// Adds a polygon to what paint() fills; overlapping ones do not add up. By lines of sub-pixels with exact ends (even-odd).
    void shape(const std::vector<ScreenPoint>& points);
    void span(double from, double to);
    void paint(const Rgba& colour);
    void stroke_line(const std::vector<ScreenPoint>& points, const Stroke& stroke);
    void stroke_piece(ScreenPoint a, ScreenPoint b, double width);

    double scale_;
    const render::TextRaster& text_;
    const render::TextRaster& bold_;
    std::vector<float> cover_; ///< 0 outside of what is being painted
    int clip_x0_ = 0, clip_y0_ = 0, clip_x1_ = 0, clip_y1_ = 0;
    int dirty_x0_ = 1 << 30, dirty_y0_ = 1 << 30, dirty_x1_ = 0, dirty_y1_ = 0;
    std::vector<float> row_; ///< of one pixel row of the shape
};

void PixelCanvas::span(double from, double to) {
    from = std::clamp(from, double(clip_x0_), double(clip_x1_));
    to = std::clamp(to, double(clip_x0_), double(clip_x1_));
    if (!(to > from))
        return;
    constexpr float part = 1.0f / rows_per_pixel;
    const int first = static_cast<int>(from), last = std::min(clip_x1_ - 1, static_cast<int>(to));
    for (int x = first; x <= last; ++x)
        row_[std::size_t(x)] += part * static_cast<float>(std::min(to, x + 1.0) - std::max(from, double(x)));
    dirty_x0_ = std::min(dirty_x0_, first);
    dirty_x1_ = std::max(dirty_x1_, last + 1);
}

void PixelCanvas::shape(const std::vector<ScreenPoint>& points) {
    if (points.size() < 3)
        return;
    std::vector<ScreenPoint> p;
    double low = 1e30, high = -1e30;
    for (const ScreenPoint& q : points) {
        p.push_back({q.x * scale_, q.y * scale_});
        low = std::min(low, p.back().y);
        high = std::max(high, p.back().y);
    }
    const int y0 = std::max(clip_y0_, static_cast<int>(std::floor(std::max(low, -1e6))));
    const int y1 = std::min(clip_y1_, static_cast<int>(std::ceil(std::min(high, 1e6))));
    std::vector<double> crossings;
    for (int y = y0; y < y1; ++y) {
        row_.assign(std::size_t(image.width), 0.0f);
        for (int sub = 0; sub < rows_per_pixel; ++sub) {
            const double at = y + (sub + 0.5) / rows_per_pixel;
            crossings.clear();
            for (std::size_t i = 0; i < p.size(); ++i) {
                const ScreenPoint &a = p[i], &b = p[(i + 1) % p.size()];
                if ((a.y <= at) != (b.y <= at))
                    crossings.push_back(a.x + (at - a.y) / (b.y - a.y) * (b.x - a.x));
            }
            std::sort(crossings.begin(), crossings.end());
            for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
                span(crossings[i], crossings[i + 1]);
        }
        float* const cover = cover_.data() + std::size_t(y) * std::size_t(image.width);
        for (int x = clip_x0_; x < clip_x1_; ++x)
            cover[x] = std::max(cover[x], row_[std::size_t(x)]);
        dirty_y0_ = std::min(dirty_y0_, y);
        dirty_y1_ = std::max(dirty_y1_, y + 1);
    }
}

void PixelCanvas::paint(const Rgba& colour) {
    for (int y = dirty_y0_; y < dirty_y1_; ++y)
        for (int x = dirty_x0_; x < dirty_x1_; ++x) {
            const std::size_t at = std::size_t(y) * std::size_t(image.width) + std::size_t(x);
            const float a = std::min(1.0f, cover_[at]) * colour[3];
            cover_[at] = 0;
            if (a <= 0)
                continue;
            for (std::size_t c = 0; c < 3; ++c) {
                std::uint8_t& v = image.rgba[at * 4 + c];
                v = static_cast<std::uint8_t>(
                    std::lround(static_cast<float>(v) * (1 - a) + 255 * colour[c] * a));
            }
        }
    dirty_x0_ = dirty_y0_ = 1 << 30;
    dirty_x1_ = dirty_y1_ = 0;
}

void PixelCanvas::stroke_piece(ScreenPoint a, ScreenPoint b, double width) {
    const double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
    if (!(length > 0))
        return;
    const double nx = -dy / length * width / 2, ny = dx / length * width / 2;
    shape({{a.x + nx, a.y + ny}, {b.x + nx, b.y + ny}, {b.x - nx, b.y - ny}, {a.x - nx, a.y - ny}});
}

void PixelCanvas::stroke_line(const std::vector<ScreenPoint>& points, const Stroke& stroke) {
    const double period = stroke.dash + stroke.gap;
    double along = 0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const ScreenPoint a = points[i], b = points[i + 1];
        const double length = std::hypot(b.x - a.x, b.y - a.y);
        if (stroke.dash <= 0) {
            stroke_piece(a, b, stroke.width);
            if (i > 0 && stroke.width * scale_ > 1.6) { // a round joint
                std::vector<ScreenPoint> circle;
                for (int k = 0; k < 12; ++k)
                    circle.push_back({a.x + stroke.width / 2 * std::cos(k * 0.5235987756),
                                      a.y + stroke.width / 2 * std::sin(k * 0.5235987756)});
                shape(circle);
            }
            continue;
        }
        if (length > 20000) // far outside of the picture
            continue;
        for (double done = 0; done < length;) {
            const bool dash = along < stroke.dash;
            const double piece =
                std::min(length - done, std::max((dash ? stroke.dash : period) - along, 0.01));
            const auto at = [&](double s) {
                return ScreenPoint{a.x + (b.x - a.x) * s / length, a.y + (b.y - a.y) * s / length};
            };
            if (dash)
                stroke_piece(at(done), at(done + piece), stroke.width);
            done += piece;
            along = along + piece >= period - 0.01 ? 0 : along + piece;
        }
    }
    paint(stroke.colour);
}

void PixelCanvas::text(ScreenPoint at, double size, const std::string& what, Anchor anchor, bool bold,
                       const Rgba& fill) {
    const render::TextRaster& font = bold && bold_.ready() ? bold_ : text_;
    const double pixels = size * scale_, width = font.width(what, pixels);
    const double x = at.x * scale_ - (anchor == Anchor::end      ? width
                                      : anchor == Anchor::middle ? width / 2
                                                                 : 0);
    font.draw(what, pixels, x, std::round(at.y * scale_), [&](int px, int py, float covered) {
        if (px < clip_x0_ || py < clip_y0_ || px >= clip_x1_ || py >= clip_y1_)
            return;
        float& cover = cover_[std::size_t(py) * std::size_t(image.width) + std::size_t(px)];
        cover = std::max(cover, covered);
        dirty_x0_ = std::min(dirty_x0_, px);
        dirty_x1_ = std::max(dirty_x1_, px + 1);
        dirty_y0_ = std::min(dirty_y0_, py);
        dirty_y1_ = std::max(dirty_y1_, py + 1);
    });
    paint(fill);
}

} // namespace

render::Image chart_image(const Chart& chart, int width, int height, double scale, bool dark) {
    const render::ImguiFonts fonts = render::default_imgui_fonts();
    const render::TextRaster text(fonts.text), bold(fonts.headings);
    if (!text.ready())
        throw_error("picture of a plot", "no font was found for its text", "Roboto; an SVG needs none");
    PixelCanvas canvas(std::max(120, width), std::max(80, height), std::clamp(scale, 1.0, 4.0), text, bold);
    paint_chart(canvas, chart, width, height, dark);
    return std::move(canvas.image);
}

} // namespace fascicle::view
