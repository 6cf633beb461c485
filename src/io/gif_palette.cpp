#include "fascicle/io/gif_palette.hpp"

#include "fascicle/base/assert.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fascicle {

namespace {

constexpr int bits = 6, side = 1 << bits, shift = 8 - bits;
constexpr std::array<double, 3> weight{0.55, 0.77, 0.33}; // roots of 0.30, 0.59, 0.11

std::size_t bin_of(int red, int green, int blue) {
    return static_cast<std::size_t>(((red >> shift) * side + (green >> shift)) * side + (blue >> shift));
}

/// A used bin: its mean colour in weighted channels.
struct Sample {
    std::array<double, 3> at{};
    double count = 0;
};

struct Box {
    std::size_t begin = 0, end = 0; ///< of the list of samples
    std::array<double, 3> mean{};
    double error = 0; ///< squared, summed over the pixels
    int axis = 0;     ///< of the largest spread
};

Box measure(const std::vector<Sample>& samples, std::size_t begin, std::size_t end) {
    Box box{begin, end, {}, 0, 0};
    double count = 0;
    std::array<double, 3> square{};
    for (std::size_t i = begin; i < end; ++i) {
        count += samples[i].count;
        for (std::size_t c = 0; c < 3; ++c)
            box.mean[c] += samples[i].count * samples[i].at[c];
    }
    for (double& m : box.mean)
        m /= std::max(count, 1e-300);
    for (std::size_t i = begin; i < end; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            square[c] +=
                samples[i].count * (samples[i].at[c] - box.mean[c]) * (samples[i].at[c] - box.mean[c]);
    for (std::size_t c = 0; c < 3; ++c) {
        box.error += square[c];
        if (square[c] > square[static_cast<std::size_t>(box.axis)])
            box.axis = static_cast<int>(c);
    }
    return box;
}

std::uint8_t to_byte(double value) {
    return static_cast<std::uint8_t>(std::clamp(std::lround(value), 0l, 255l));
}

double distance2(const Rgb8& a, double red, double green, double blue) {
    const double r = weight[0] * (a[0] - red), g = weight[1] * (a[1] - green), b = weight[2] * (a[2] - blue);
    return r * r + g * g + b * b;
}

} // namespace

GifPalette::GifPalette(std::vector<Rgb8> colours)
    : colours_(std::move(colours)), known_(std::size_t{side} * side * side, -1) {
    FASCICLE_ASSERT(!colours_.empty() && colours_.size() <= 255);
    std::vector<double> gaps;
    for (std::size_t i = 0; i < colours_.size(); ++i) {
        double least = std::numeric_limits<double>::max();
        for (std::size_t k = 0; k < colours_.size(); ++k)
            if (k != i)
                least = std::min(least, std::hypot(double(colours_[i][0]) - colours_[k][0],
                                                   double(colours_[i][1]) - colours_[k][1],
                                                   double(colours_[i][2]) - colours_[k][2]));
        gaps.push_back(least);
    }
    if (gaps.size() > 1) {
        std::nth_element(gaps.begin(), gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2),
                         gaps.end());
        spacing_ = std::min(gaps[gaps.size() / 2], 64.0);
    }
}

std::uint8_t GifPalette::nearest(int red, int green, int blue) {
    std::int16_t& known = known_[bin_of(red, green, blue)];
    if (known < 0) {
        const auto middle = [](int v) { return (v >> shift << shift) + ((1 << shift) - 1) / 2.0; };
        double least = std::numeric_limits<double>::max();
        for (std::size_t i = 0; i < colours_.size(); ++i)
            if (const double d = distance2(colours_[i], middle(red), middle(green), middle(blue));
                d < least) {
                least = d;
                known = static_cast<std::int16_t>(i);
            }
    }
    return static_cast<std::uint8_t>(known);
}

PaletteSampler::PaletteSampler() : bins_(std::size_t{side} * side * side) {}

void PaletteSampler::add(const std::uint8_t* rgba, std::size_t pixels) {
    for (std::size_t i = 0; i < pixels; ++i, rgba += 4) {
        Bin& bin = bins_[bin_of(rgba[0], rgba[1], rgba[2])];
        bin.count += 1;
        for (std::size_t c = 0; c < 3; ++c)
            bin.sum[c] += rgba[c];
    }
}

GifPalette PaletteSampler::choose(int most) const {
    FASCICLE_ASSERT(most >= 1 && most <= 255);
    std::vector<Sample> samples;
    for (const Bin& bin : bins_)
        if (bin.count > 0) {
            Sample sample;
            // A root: a background of half the picture must not take half of the colours.
            sample.count = std::sqrt(bin.count);
            for (std::size_t c = 0; c < 3; ++c)
                sample.at[c] = weight[c] * bin.sum[c] / bin.count;
            samples.push_back(sample);
        }
    if (samples.empty())
        return GifPalette({Rgb8{0, 0, 0}});
    std::vector<Box> boxes{measure(samples, 0, samples.size())};
    while (static_cast<int>(boxes.size()) < most) {
        const auto worst = std::max_element(boxes.begin(), boxes.end(),
                                            [](const Box& a, const Box& b) { return a.error < b.error; });
        if (worst->end - worst->begin < 2 || worst->error <= 0)
            break; // every colour there is has a box
        const auto axis = static_cast<std::size_t>(worst->axis);
        const double at = worst->mean[axis];
        const auto first = samples.begin() + static_cast<std::ptrdiff_t>(worst->begin);
        const auto last = samples.begin() + static_cast<std::ptrdiff_t>(worst->end);
        const auto middle =
            std::partition(first, last, [&](const Sample& sample) { return sample.at[axis] < at; });
        if (middle == first || middle == last) { // rounding alone told them apart
            worst->error = 0;
            continue;
        }
        const auto cut = static_cast<std::size_t>(middle - samples.begin());
        const Box high = measure(samples, cut, worst->end);
        *worst = measure(samples, worst->begin, cut);
        boxes.push_back(high);
    }
    std::vector<Rgb8> colours;
    for (const Box& box : boxes)
        colours.push_back({to_byte(box.mean[0] / weight[0]), to_byte(box.mean[1] / weight[1]),
                           to_byte(box.mean[2] / weight[2])});
    std::sort(colours.begin(), colours.end());
    colours.erase(std::unique(colours.begin(), colours.end()), colours.end());
    return GifPalette(std::move(colours));
}

} // namespace fascicle
