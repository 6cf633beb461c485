#include "view/chart_painter.hpp"

#include "view/ticks.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::view {

namespace {

using render::Rgba;
using Anchor = ChartCanvas::Anchor;

constexpr Rgba rgb(unsigned hex) {
    return {static_cast<float>((hex >> 16) & 255) / 255.0f, static_cast<float>((hex >> 8) & 255) / 255.0f,
            static_cast<float>(hex & 255) / 255.0f, 1.0f};
}

struct Ink {
    Rgba ground, plot, grid, axis, text, faint, playhead;
};
constexpr Ink light_ink{rgb(0xffffff), rgb(0xffffff), rgb(0xe6e9ee), rgb(0x7b8594),
                        rgb(0x1d232c), rgb(0x5a6473), rgb(0x11151b)};
constexpr Ink dark_ink{rgb(0x191c22), rgb(0x14161b), rgb(0x292e37), rgb(0x737c8a),
                       rgb(0xe4e7ec), rgb(0xa4acb9), rgb(0xffffff)};

/// About as wide as the text in a common sans-serif face, pixels.
double text_width(const std::string& text, double size) {
    double characters = 0;
    for (const char c : text)
        characters += (static_cast<unsigned char>(c) & 0xc0) != 0x80 ? 1 : 0;
    return characters * size * 0.55;
}

class Painter {
public:
    Painter(ChartCanvas& canvas, const Chart& chart, int width, int height, bool dark)
        : canvas_(canvas), chart_(chart), ink_(dark ? dark_ink : light_ink), width_(std::max(120, width)),
          height_(std::max(80, height)), x_(chart_x(chart)), y_(chart_y(chart)) {}

    void draw() {
        canvas_.rectangle(0, 0, width_, height_, ink_.ground);
        canvas_.text({margin, margin + 11}, 13, chart_heading(chart_), Anchor::start, true, ink_.text);
        const double below_legend = legend(margin + 19);
        const Ticks rows = y_ticks(below_legend);
        layout(below_legend, rows);
        if (right_ - left_ < 10 || bottom_ - top_ < 10)
            return;
        canvas_.rectangle(left_, top_, right_ - left_, bottom_ - top_, ink_.plot);
        grid(rows);
        canvas_.clip(left_, top_, right_ - left_, bottom_ - top_);
        if (chart_.reference)
            canvas_.line({left_, py(*chart_.reference)}, {right_, py(*chart_.reference)},
                         {ink_.axis, 1, 4, 3});
        curves();
        if (chart_.playhead && *chart_.playhead >= x_.low && *chart_.playhead <= x_.high)
            canvas_.line({px(*chart_.playhead), top_}, {px(*chart_.playhead), bottom_}, {ink_.playhead, 1});
        canvas_.unclip();
        canvas_.line({left_, top_}, {left_, bottom_}, {ink_.axis, 1});
        canvas_.line({left_, bottom_}, {right_, bottom_}, {ink_.axis, 1});
        if (!chart_.x_label.empty())
            canvas_.text({(left_ + right_) / 2, height_ - margin + 1}, 11, chart_.x_label, Anchor::middle,
                         false, ink_.text);
    }

private:
    static constexpr double margin = 10;

    double px(double x) const { return left_ + (x - x_.low) / (x_.high - x_.low) * (right_ - left_); }
    double py(double y) const { return bottom_ - (y - y_.low) / (y_.high - y_.low) * (bottom_ - top_); }

    Ticks y_ticks(double top) const {
        const double room = std::max(1.0, height_ - top - 40);
        return scale_ticks(y_.low, y_.high, std::max(1, static_cast<int>(room / 28)), 14 / room);
    }

    void layout(double top, const Ticks& rows) {
        double widest = 0;
        for (int i = 0; i < rows.count; ++i)
            widest = std::max(widest, text_width(tick_text(rows.at(i), rows.step), 11));
        left_ = std::round(margin + widest + 6);
        right_ = width_ - margin - 6;
        top_ = top;
        bottom_ = height_ - margin - (chart_.x_label.empty() ? 18 : 31);
    }

    void grid(const Ticks& rows) {
        for (int i = 0; i < rows.count; ++i) {
            canvas_.line({left_, py(rows.at(i))}, {right_, py(rows.at(i))}, {ink_.grid, 1});
            canvas_.text({left_ - 6, py(rows.at(i)) + 4}, 11, tick_text(rows.at(i), rows.step), Anchor::end,
                         false, ink_.faint);
        }
        const Ticks columns =
            scale_ticks(x_.low, x_.high, std::max(1, static_cast<int>((right_ - left_) / 62)),
                        40 / std::max(1.0, right_ - left_));
        for (int i = 0; i < columns.count; ++i) {
            canvas_.line({px(columns.at(i)), top_}, {px(columns.at(i)), bottom_}, {ink_.grid, 1});
            canvas_.text({px(columns.at(i)), bottom_ + 14}, 11, tick_text(columns.at(i), columns.step),
                         Anchor::middle, false, ink_.faint);
        }
    }

    /// Entries beside each other, in as many rows as they need; returns where the plot begins.
    double legend(double y) {
        double x = margin;
        const ChartCurve* last = nullptr;
        bool any = false;
        for (const ChartCurve& curve : chart_.curves) {
            if (curve.name.empty() || curve.ghost || (last != nullptr && last->name == curve.name))
                continue;
            last = &curve;
            const double wide = 22 + text_width(curve.name, 11) + 14;
            if (any && x + wide > width_ - margin) {
                x = margin;
                y += 16;
            }
            if (curve.width > 0)
                canvas_.line({x, y + 6}, {x + 17, y + 6},
                             {curve.colour, std::max(curve.width, 1.5), curve.dashed ? 5.0 : 0.0, 3});
            else
                canvas_.rectangle(x + 4, y + 1, 10, 10, curve.colour);
            canvas_.text({x + 22, y + 10}, 11, curve.name, Anchor::start, false, ink_.faint);
            x += wide;
            any = true;
        }
        return any ? y + 22 : y + 4;
    }

    void curves() {
        for (const ChartCurve& curve : chart_.curves)
            if (curve.ghost)
                curve_line(curve);
        for (const ChartCurve& curve : chart_.curves)
            if (!curve.ghost)
                band(curve);
        for (const ChartCurve& curve : chart_.curves)
            if (!curve.ghost)
                curve_line(curve);
    }

    /// Runs of finite samples, cut down to what pixels can show.
    template <class Draw>
    void runs(const ChartCurve& curve, bool with_band, Draw draw) const {
        std::vector<ScreenPoint> points, low;
        const auto flush = [&] {
            if (!points.empty())
                draw(points, low);
            points.clear();
            low.clear();
        };
        const std::size_t count = with_band ? std::min({curve.x.size(), curve.low.size(), curve.high.size()})
                                            : std::min(curve.x.size(), curve.y.size());
        for (std::size_t k = 0; k < count; ++k) {
            const double upper = with_band ? curve.high[k] : curve.y[k];
            if (!std::isfinite(curve.x[k]) || !std::isfinite(upper) ||
                (with_band && !std::isfinite(curve.low[k]))) {
                flush();
                continue;
            }
            points.push_back(at(curve.x[k], upper));
            if (with_band)
                low.push_back(at(curve.x[k], curve.low[k]));
        }
        flush();
    }

    /// Far outside of the picture is as good as outside.
    ScreenPoint at(double x, double y) const {
        return {std::clamp(px(x), -1e5, 1e5), std::clamp(py(y), -1e5, 1e5)};
    }

    void band(const ChartCurve& curve) {
        Rgba fill = curve.colour;
        fill[3] = static_cast<float>(curve.band_opacity);
        runs(curve, true, [&](const std::vector<ScreenPoint>& high, const std::vector<ScreenPoint>& low) {
            canvas_.band(decimated(high), decimated(low), fill);
        });
    }

    void curve_line(const ChartCurve& curve) {
        if (curve.width <= 0 && !curve.ghost)
            return;
        ChartCanvas::Stroke stroke{curve.colour, curve.ghost ? 1.0 : curve.width, curve.dashed ? 5.0 : 0.0,
                                   3};
        if (curve.ghost)
            stroke.colour[3] = 0.4f;
        runs(curve, false, [&](const std::vector<ScreenPoint>& all, const std::vector<ScreenPoint>&) {
            if (all.size() == 1)
                canvas_.dot(all[0], stroke.width * 1.4, stroke.colour);
            else
                canvas_.polyline(curve.ghost ? ChartCanvas::Kind::ghost : ChartCanvas::Kind::curve,
                                 decimated(all), stroke);
        });
    }

    ChartCanvas& canvas_;
    const Chart& chart_;
    const Ink& ink_;
    double width_, height_;
    ChartSpan x_, y_;
    double left_ = 0, right_ = 0, top_ = 0, bottom_ = 0;
};

} // namespace

void paint_chart(ChartCanvas& canvas, const Chart& chart, int width, int height, bool dark) {
    Painter(canvas, chart, width, height, dark).draw();
}

} // namespace fascicle::view
