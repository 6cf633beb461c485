#pragma once
// The colours of a GIF: one palette for all frames, chosen from samples of them, so that nothing flickers.

#include <array>
#include <cstdint>
#include <vector>

namespace fascicle {

using Rgb8 = std::array<std::uint8_t, 3>;

/// At most 255 sRGB colours, and which of them is nearest to a colour. Not thread-safe: nearest() remembers.
class GifPalette {
public:
    explicit GifPalette(std::vector<Rgb8> colours);

    const std::vector<Rgb8>& colours() const { return colours_; }
    /// Index of the nearest colour to within the width of a bin (4 levels of 256 a channel).
    std::uint8_t nearest(int red, int green, int blue);
    /// Typical distance of neighbouring colours, levels of 256: how strongly a dither pattern must push.
    double spacing() const { return spacing_; }

private:
    std::vector<Rgb8> colours_;
    double spacing_ = 0;
    std::vector<std::int16_t> known_; ///< by bin of 64 x 64 x 64; -1: not looked for yet
};

/// Collects samples and chooses colours by variance cut: the box of colours with the largest squared error is halved at
/// its mean, along the channel in which it spreads most, until there are enough boxes; each gives its mean colour. Channels count by
/// what the eye sees of them (sRGB luma: 0.30, 0.59, 0.11), softened by a root.
class PaletteSampler {
public:
    PaletteSampler();
    /// 4 * pixels bytes, red green blue alpha; alpha is passed over.
    void add(const std::uint8_t* rgba, std::size_t pixels);
    /// 1 to `most` colours; black alone when nothing was added.
    GifPalette choose(int most = 255) const;

private:
    struct Bin {
        double count = 0;
        std::array<double, 3> sum{};
    };
    std::vector<Bin> bins_; ///< 64 x 64 x 64
};

} // namespace fascicle
