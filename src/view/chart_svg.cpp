#include "view/chart_svg.hpp"

#include "view/chart_painter.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace fascicle::view {

namespace {

/// At most two decimals, none that are 0; a dot in every locale.
std::string number(double value) {
    char buffer[64];
    std::string text(buffer,
                     std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, 2).ptr);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.')
        text.pop_back();
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

std::string attribute(const char* name, const std::string& value) {
    return std::string(" ") + name + "=\"" + value + "\"";
}
std::string attribute(const char* name, double value) {
    return attribute(name, number(value));
}

class SvgCanvas : public ChartCanvas {
public:
    void rectangle(double x, double y, double width, double height, const render::Rgba& fill) override {
        out += "<rect" + attribute("x", x) + attribute("y", y) + attribute("width", width) +
               attribute("height", height) + attribute("fill", hex(fill)) + "/>\n";
    }
    void line(ScreenPoint from, ScreenPoint to, const Stroke& stroke) override {
        out += "<line" + attribute("x1", from.x) + attribute("y1", from.y) + attribute("x2", to.x) +
               attribute("y2", to.y) + stroked(stroke) + "/>\n";
    }
    void polyline(Kind kind, const std::vector<ScreenPoint>& points, const Stroke& stroke) override {
        out += std::string("<path class=\"") + (kind == Kind::ghost ? "ghost" : "curve") + "\"" +
               attribute("d", path(points, true)) + " fill=\"none\" stroke-linejoin=\"round\"" +
               stroked(stroke) + "/>\n";
    }
    void band(const std::vector<ScreenPoint>& upper, const std::vector<ScreenPoint>& lower,
              const render::Rgba& fill) override {
        const std::vector<ScreenPoint> back(lower.rbegin(), lower.rend());
        out += "<path class=\"band\"" + attribute("d", path(upper, true) + path(back, false) + "Z") +
               attribute("fill", hex(fill)) + attribute("fill-opacity", double(fill[3])) + "/>\n";
    }
    void dot(ScreenPoint centre, double radius, const render::Rgba& fill) override {
        out += "<circle" + attribute("cx", centre.x) + attribute("cy", centre.y) + attribute("r", radius) +
               attribute("fill", hex(fill)) + "/>\n";
    }
    void text(ScreenPoint at, double size, const std::string& what, Anchor anchor, bool bold,
              const render::Rgba& fill) override {
        const char* const where = anchor == Anchor::start    ? "start"
                                  : anchor == Anchor::middle ? "middle"
                                                             : "end";
        out += "<text" + attribute("x", at.x) + attribute("y", at.y) + attribute("font-size", size) +
               attribute("fill", hex(fill)) + attribute("text-anchor", std::string(where)) +
               (bold ? " font-weight=\"bold\"" : "") + ">" + xml_escaped(what) + "</text>\n";
    }
    /// By a nested <svg>, which needs no id: many charts can share one page.
    void clip(double x, double y, double width, double height) override {
        out +=
            "<svg" + attribute("x", x) + attribute("y", y) + attribute("width", width) +
            attribute("height", height) +
            attribute("viewBox", number(x) + " " + number(y) + " " + number(width) + " " + number(height)) +
            ">\n";
    }
    void unclip() override { out += "</svg>\n"; }

    std::string out;

private:
    static std::string stroked(const Stroke& stroke) {
        std::string text = attribute("stroke", hex(stroke.colour)) + attribute("stroke-width", stroke.width);
        if (stroke.colour[3] < 1)
            text += attribute("stroke-opacity", double(stroke.colour[3]));
        if (stroke.dash > 0)
            text += attribute("stroke-dasharray", number(stroke.dash) + " " + number(stroke.gap));
        return text;
    }
    static std::string path(const std::vector<ScreenPoint>& points, bool first_moves) {
        std::string d;
        for (std::size_t i = 0; i < points.size(); ++i)
            d += (i == 0 && first_moves ? "M" : "L") + number(points[i].x) + " " + number(points[i].y);
        return d;
    }
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
    width = std::max(120, width);
    height = std::max(80, height);
    SvgCanvas canvas;
    paint_chart(canvas, chart, width, height, dark);
    return "<svg xmlns=\"http://www.w3.org/2000/svg\"" + attribute("width", width) +
           attribute("height", height) + attribute("viewBox", "0 0 " + number(width) + " " + number(height)) +
           " role=\"img\" font-family=\"Helvetica, Arial, 'Liberation Sans', sans-serif\">\n<title>" +
           xml_escaped(chart_heading(chart)) + "</title>\n" + canvas.out + "</svg>\n";
}

} // namespace fascicle::view
