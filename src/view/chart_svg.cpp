#include "view/chart_svg.hpp"

#include "view/decimate.hpp"
#include "view/ticks.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace fascicle::view {

namespace {

struct Ink {
    const char *ground, *plot, *grid, *axis, *text, *faint, *playhead;
};
constexpr Ink light_ink{"#ffffff", "#ffffff", "#e6e9ee", "#7b8594", "#1d232c", "#5a6473", "#11151b"};
constexpr Ink dark_ink{"#191c22", "#14161b", "#292e37", "#737c8a", "#e4e7ec", "#a4acb9", "#ffffff"};

/// At most `digits` decimals, none that are 0.
std::string number(double value, int digits = 2) {
    char buffer[64];
    std::string text(
        buffer, std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, digits).ptr);
    if (text.find('.') != std::string::npos) {
        text.erase(text.find_last_not_of('0') + 1);
        if (text.back() == '.')
            text.pop_back();
    }
    return text == "-0" ? "0" : text;
}

std::string hex(const render::Rgba& colour) {
    std::string text = "#";
    for (std::size_t i = 0; i < 3; ++i) {
        const long v = std::lround(std::clamp(double(colour[i]), 0.0, 1.0) * 255);
        text += "0123456789abcdef"[v >> 4];
        text += "0123456789abcdef"[v & 15];
    }
    return text;
}

/// Attribute lists are put together here alone.
std::string attribute(const char* name, const std::string& value) {
    return std::string(" ") + name + "=\"" + value + "\"";
}
std::string attribute(const char* name, double value) {
    return attribute(name, number(value));
}

/// About as wide as the text in a common sans-serif face, pixels.
double text_width(const std::string& text, double size) {
    double characters = 0;
    for (const char c : text)
        characters += (static_cast<unsigned char>(c) & 0xc0) != 0x80 ? 1 : 0;
    return characters * size * 0.55;
}

class Picture {
public:
    Picture(const Chart& chart, int width, int height, bool dark)
        : chart_(chart), ink_(dark ? dark_ink : light_ink), width_(std::max(120, width)),
          height_(std::max(80, height)), x_(chart_x(chart)), y_(chart_y(chart)) {}

    std::string draw() {
        out_ = "<svg xmlns=\"http://www.w3.org/2000/svg\"" + attribute("width", width_) +
               attribute("height", height_) +
               attribute("viewBox", "0 0 " + number(width_) + " " + number(height_)) +
               " role=\"img\" font-family=\"Helvetica, Arial, 'Liberation Sans', sans-serif\">\n";
        out_ += "<title>" + xml_escaped(chart_heading(chart_)) + "</title>\n";
        rectangle(0, 0, width_, height_, ink_.ground);
        text(margin, margin + 11, 13, ink_.text, chart_heading(chart_), "start", true);
        const double below_legend = legend(margin + 19);
        const Ticks rows = y_ticks(below_legend);
        layout(below_legend, rows);
        if (right_ - left_ < 10 || bottom_ - top_ < 10)
            return out_ + "</svg>\n";
        rectangle(left_, top_, right_ - left_, bottom_ - top_, ink_.plot);
        grid(rows);
        // Clipping by a nested <svg> needs no id: many charts can share one page.
        out_ += "<svg" + attribute("x", left_) + attribute("y", top_) + attribute("width", right_ - left_) +
                attribute("height", bottom_ - top_) +
                attribute("viewBox", number(left_) + " " + number(top_) + " " + number(right_ - left_) + " " +
                                         number(bottom_ - top_)) +
                ">\n";
        if (chart_.reference)
            line(left_, py(*chart_.reference), right_, py(*chart_.reference), ink_.axis, 1, "4 3");
        for (const ChartCurve& curve : chart_.curves)
            if (curve.ghost)
                curve_line(curve);
        for (const ChartCurve& curve : chart_.curves)
            if (!curve.ghost)
                band(curve);
        for (const ChartCurve& curve : chart_.curves)
            if (!curve.ghost)
                curve_line(curve);
        if (chart_.playhead && *chart_.playhead >= x_.low && *chart_.playhead <= x_.high)
            line(px(*chart_.playhead), top_, px(*chart_.playhead), bottom_, ink_.playhead, 1);
        out_ += "</svg>\n";
        line(left_, top_, left_, bottom_, ink_.axis, 1);
        line(left_, bottom_, right_, bottom_, ink_.axis, 1);
        text((left_ + right_) / 2, height_ - margin + 1, 11, ink_.text, chart_.x_label, "middle");
        return out_ + "</svg>\n";
    }

private:
    static constexpr double margin = 10;

    double px(double x) const { return left_ + (x - x_.low) / (x_.high - x_.low) * (right_ - left_); }
    double py(double y) const { return bottom_ - (y - y_.low) / (y_.high - y_.low) * (bottom_ - top_); }

    Ticks y_ticks(double top) const {
        return nice_ticks(y_.low, y_.high, std::max(1, static_cast<int>((height_ - top - 40) / 28)));
    }

    void layout(double top, const Ticks& rows) {
        double widest = 0;
        for (int i = 0; i < rows.count; ++i)
            widest = std::max(widest, text_width(tick_text(rows.at(i), rows.step), 11));
        left_ = margin + widest + 6;
        right_ = width_ - margin - 6;
        top_ = top;
        bottom_ = height_ - margin - (chart_.x_label.empty() ? 18 : 31);
    }

    void grid(const Ticks& rows) {
        for (int i = 0; i < rows.count; ++i) {
            line(left_, py(rows.at(i)), right_, py(rows.at(i)), ink_.grid, 1);
            text(left_ - 6, py(rows.at(i)) + 4, 11, ink_.faint, tick_text(rows.at(i), rows.step), "end");
        }
        const Ticks columns =
            nice_ticks(x_.low, x_.high, std::max(1, static_cast<int>((right_ - left_) / 62)));
        for (int i = 0; i < columns.count; ++i) {
            line(px(columns.at(i)), top_, px(columns.at(i)), bottom_, ink_.grid, 1);
            text(px(columns.at(i)), bottom_ + 14, 11, ink_.faint, tick_text(columns.at(i), columns.step),
                 "middle");
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
                line(x, y + 6, x + 17, y + 6, hex(curve.colour), std::max(curve.width, 1.5),
                     curve.dashed ? "5 3" : "");
            else
                rectangle(x + 4, y + 1, 10, 10, hex(curve.colour));
            text(x + 22, y + 10, 11, ink_.faint, curve.name, "start");
            x += wide;
            any = true;
        }
        return any ? y + 22 : y + 4;
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
            points.push_back({px(curve.x[k]), py(upper)});
            if (with_band)
                low.push_back({px(curve.x[k]), py(curve.low[k])});
        }
        flush();
    }

    static std::string path(const std::vector<ScreenPoint>& points, bool first_moves) {
        std::string d;
        for (std::size_t i = 0; i < points.size(); ++i)
            d += (i == 0 && first_moves ? "M" : "L") + number(points[i].x) + " " + number(points[i].y);
        return d;
    }

    void band(const ChartCurve& curve) {
        runs(curve, true, [&](const std::vector<ScreenPoint>& high, std::vector<ScreenPoint>& low) {
            std::vector<ScreenPoint> back = decimated(low);
            std::reverse(back.begin(), back.end());
            out_ += "<path class=\"band\"" +
                    attribute("d", path(decimated(high), true) + path(back, false) + "Z") +
                    attribute("fill", hex(curve.colour)) + attribute("fill-opacity", curve.band_opacity) +
                    "/>\n";
        });
    }

    void curve_line(const ChartCurve& curve) {
        if (curve.width <= 0)
            return;
        runs(curve, false, [&](const std::vector<ScreenPoint>& all, const std::vector<ScreenPoint>&) {
            const double wide = curve.ghost ? 1.0 : curve.width;
            if (all.size() == 1) {
                out_ += "<circle" + attribute("cx", all[0].x) + attribute("cy", all[0].y) +
                        attribute("r", wide * 1.4) + attribute("fill", hex(curve.colour)) + "/>\n";
                return;
            }
            out_ +=
                std::string("<path class=\"") + (curve.ghost ? "ghost" : "curve") + "\"" +
                attribute("d", path(decimated(all), true)) + " fill=\"none\"" +
                attribute("stroke", hex(curve.colour)) + attribute("stroke-width", wide) +
                " stroke-linejoin=\"round\"" +
                (curve.ghost ? attribute("stroke-opacity", 0.35) : std::string()) +
                (!curve.ghost && curve.colour[3] < 1 ? attribute("stroke-opacity", double(curve.colour[3]))
                                                     : std::string()) +
                (curve.dashed ? attribute("stroke-dasharray", std::string("5 3")) : std::string()) + "/>\n";
        });
    }

    void rectangle(double x, double y, double wide, double high, const std::string& fill) {
        out_ += "<rect" + attribute("x", x) + attribute("y", y) + attribute("width", wide) +
                attribute("height", high) + attribute("fill", fill) + "/>\n";
    }

    void line(double x0, double y0, double x1, double y1, const std::string& colour, double wide,
              const std::string& dashes = {}) {
        out_ += "<line" + attribute("x1", x0) + attribute("y1", y0) + attribute("x2", x1) +
                attribute("y2", y1) + attribute("stroke", colour) + attribute("stroke-width", wide) +
                (dashes.empty() ? std::string() : attribute("stroke-dasharray", dashes)) + "/>\n";
    }

    void text(double x, double y, double size, const std::string& colour, const std::string& what,
              const char* anchor, bool bold = false) {
        if (what.empty())
            return;
        out_ += "<text" + attribute("x", x) + attribute("y", y) + attribute("font-size", size) +
                attribute("fill", colour) + attribute("text-anchor", std::string(anchor)) +
                (bold ? " font-weight=\"bold\"" : "") + ">" + xml_escaped(what) + "</text>\n";
    }

    const Chart& chart_;
    const Ink& ink_;
    double width_, height_;
    ChartSpan x_, y_;
    double left_ = 0, right_ = 0, top_ = 0, bottom_ = 0;
    std::string out_;
};

} // namespace

std::string xml_escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        case '&':
            result += "&amp;";
            break;
        case '"':
            result += "&quot;";
            break;
        case '\'':
            result += "&#39;";
            break;
        default:
            if (static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t')
                result += c;
        }
    }
    return result;
}

std::string chart_svg(const Chart& chart, int width, int height, bool dark) {
    return Picture(chart, width, height, dark).draw();
}

} // namespace fascicle::view
