#include "render/image.hpp"

#include "fascicle/base/assert.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace fascicle::render {

double differing_share(const Image& a, const Image& b, int tolerance) {
    if (a.width != b.width || a.height != b.height || a.rgba.size() != b.rgba.size())
        return 1.0;
    if (a.rgba.empty())
        return 0.0;
    std::size_t differing = 0;
    for (std::size_t pixel = 0; pixel < a.rgba.size(); pixel += 4) {
        bool differs = false;
        for (std::size_t c = pixel; c < pixel + 4; ++c)
            differs = differs || std::abs(a.rgba[c] - b.rgba[c]) > tolerance;
        differing += differs ? 1 : 0;
    }
    return static_cast<double>(differing) / static_cast<double>(a.rgba.size() / 4);
}

Image film_strip(const std::vector<Image>& images, int gap, const Rgba& colour) {
    FASCICLE_ASSERT(gap >= 0);
    Image strip;
    for (const Image& image : images) {
        strip.width += image.width + (&image == &images.front() ? 0 : gap);
        strip.height = std::max(strip.height, image.height);
    }
    const std::size_t row = std::size_t{4} * static_cast<std::size_t>(strip.width);
    strip.rgba.resize(row * static_cast<std::size_t>(strip.height));
    for (std::size_t i = 0; i < strip.rgba.size(); ++i)
        strip.rgba[i] =
            static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(colour[i % 4], 0.0f, 1.0f)));
    std::size_t left = 0;
    for (const Image& image : images) {
        const std::size_t bytes = std::size_t{4} * static_cast<std::size_t>(image.width);
        for (std::size_t y = 0; y < static_cast<std::size_t>(image.height); ++y)
            std::copy_n(image.rgba.data() + y * bytes, bytes, strip.rgba.data() + y * row + left);
        left += bytes + std::size_t{4} * static_cast<std::size_t>(gap);
    }
    return strip;
}

Image downsample(const Image& image, int factor) {
    FASCICLE_ASSERT(factor >= 1);
    Image small{image.width / factor, image.height / factor, {}};
    small.rgba.resize(std::size_t{4} * static_cast<std::size_t>(small.width) *
                      static_cast<std::size_t>(small.height));
    const unsigned samples = static_cast<unsigned>(factor) * static_cast<unsigned>(factor);
    for (int y = 0; y < small.height; ++y)
        for (int x = 0; x < small.width; ++x) {
            unsigned weighted[3] = {0, 0, 0}, alpha = 0;
            for (int sample_y = y * factor; sample_y < (y + 1) * factor; ++sample_y)
                for (int sample_x = x * factor; sample_x < (x + 1) * factor; ++sample_x) {
                    const std::uint8_t* from =
                        image.rgba.data() + std::size_t{4} * (static_cast<std::size_t>(sample_y) *
                                                                  static_cast<std::size_t>(image.width) +
                                                              static_cast<std::size_t>(sample_x));
                    for (int c = 0; c < 3; ++c)
                        weighted[c] += unsigned{from[c]} * from[3];
                    alpha += from[3];
                }
            std::uint8_t* to =
                small.rgba.data() +
                std::size_t{4} * (static_cast<std::size_t>(y) * static_cast<std::size_t>(small.width) +
                                  static_cast<std::size_t>(x));
            for (int c = 0; c < 3; ++c)
                to[c] = alpha == 0 ? std::uint8_t{0}
                                   : static_cast<std::uint8_t>((weighted[c] + alpha / 2) / alpha);
            to[3] = static_cast<std::uint8_t>((alpha + samples / 2) / samples);
        }
    return small;
}

} // namespace fascicle::render
