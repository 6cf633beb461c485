#include "fascicle/base/assert.hpp"
#include "fascicle/io/fibre_template_file.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle {

namespace {

struct Colour {
    double red, green, blue, alpha;
};

/// Colours over transparent, drawn in order, alpha by coverage.
class Canvas {
public:
    explicit Canvas(int size)
        : size_(size), pixels_(static_cast<std::size_t>(size) * static_cast<std::size_t>(size), Colour{}) {}

    /// A line of `width` pixels with round ends; coverage by the distance of the pixel's middle.
    void line(const Vec2& a, const Vec2& b, double width, const Colour& colour) {
        const double reach = 0.5 * width + 1.0;
        const auto first = [&](double u, double v) {
            return std::clamp(static_cast<int>(std::min(u, v) - reach), 0, size_ - 1);
        };
        const auto last = [&](double u, double v) {
            return std::clamp(static_cast<int>(std::max(u, v) + reach), 0, size_ - 1);
        };
        const Vec2 d = b - a;
        for (int y = first(a.y(), b.y()); y <= last(a.y(), b.y()); ++y)
            for (int x = first(a.x(), b.x()); x <= last(a.x(), b.x()); ++x) {
                const Vec2 p(x + 0.5, y + 0.5);
                const double squared = d.squaredNorm();
                const double share = squared > 0 ? std::clamp((p - a).dot(d) / squared, 0.0, 1.0) : 0.0;
                const double coverage = std::clamp(0.5 + 0.5 * width - (a + share * d - p).norm(), 0.0, 1.0);
                over(x, y, colour, coverage * colour.alpha);
            }
    }

    PngImage image() const {
        PngImage image{size_, size_, {}};
        for (const Colour& c : pixels_)
            for (const double value : {c.red, c.green, c.blue, c.alpha})
                image.rgba.push_back(
                    static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(value, 0.0, 1.0))));
        return image;
    }

private:
    void over(int x, int y, const Colour& colour, double alpha) {
        if (alpha <= 0)
            return;
        Colour& below = pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(size_) +
                                static_cast<std::size_t>(x)];
        const double sum = alpha + below.alpha * (1.0 - alpha);
        const auto mix = [&](double top, double under) {
            return (top * alpha + under * below.alpha * (1.0 - alpha)) / sum;
        };
        below = {mix(colour.red, below.red), mix(colour.green, below.green), mix(colour.blue, below.blue),
                 sum};
    }

    int size_;
    std::vector<Colour> pixels_;
};

} // namespace

PngImage draw_fibre_template(const FibreTemplate& fibre_template, int size) {
    FASCICLE_ASSERT(size >= 16 && size <= 4096);
    Canvas canvas(size);
    // Cabinet projection: x to the right, y (origin to insertion) upwards, z backwards to the upper right.
    const double margin = 0.08 * size, unit = (size - 2 * margin) / 1.35;
    const auto place = [&](const Vec3& p) {
        return Vec2(margin + unit * (p.x() + 0.35 * p.z()), size - margin - unit * (p.y() + 0.35 * p.z()));
    };
    const Colour frame{0.5, 0.5, 0.55, 0.55};
    for (int corner = 0; corner < 8; ++corner)
        for (int axis = 0; axis < 3; ++axis)
            if ((corner >> axis & 1) == 0) {
                const auto at = [&](int k) { return place(Vec3(k & 1, k >> 1 & 1, k >> 2)); };
                canvas.line(at(corner), at(corner | 1 << axis), size / 96.0, frame);
            }
    constexpr int across = 6, pieces = 48;
    for (int layer = 2; layer >= 0; --layer) // the back first
        for (int i = 0; i <= across; ++i) {
            const double r = 0.5 * layer, s = double(i) / across;
            const double fade = 0.45 * r;
            const Colour colour{0.78 + 0.1 * fade, 0.22 + 0.6 * fade, 0.2 + 0.6 * fade, 1.0};
            Vec2 before = place(fibre_template.point(r, s, 0));
            for (int k = 1; k <= pieces; ++k) {
                const Vec2 here = place(fibre_template.point(r, s, double(k) / pieces));
                canvas.line(before, here, size / 64.0, colour);
                before = here;
            }
        }
    return canvas.image();
}

} // namespace fascicle
