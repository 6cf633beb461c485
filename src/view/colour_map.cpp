#include "view/colour_map.hpp"

#include "fascicle/base/assert.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>

namespace fascicle::view {

namespace {

using Rgb = std::array<float, 3>;

// Control values at equal steps; linear in between (sRGB values), within 0.05 of the published 256.
// viridis (N. Smith and S. van der Walt, 2015, CC0): every 15th of the 256 published values.
constexpr Rgb viridis[] = {
    {0.267004f, 0.004874f, 0.329415f}, {0.281924f, 0.089666f, 0.412415f}, {0.280255f, 0.165693f, 0.476498f},
    {0.263663f, 0.237631f, 0.518762f}, {0.237441f, 0.305202f, 0.541921f}, {0.208623f, 0.367752f, 0.552675f},
    {0.182256f, 0.426184f, 0.557120f}, {0.159194f, 0.482237f, 0.558073f}, {0.137770f, 0.537492f, 0.554906f},
    {0.121148f, 0.592739f, 0.544641f}, {0.128087f, 0.647749f, 0.523491f}, {0.180653f, 0.701402f, 0.488189f},
    {0.274149f, 0.751988f, 0.436601f}, {0.395174f, 0.797475f, 0.367757f}, {0.535621f, 0.835785f, 0.281908f},
    {0.688944f, 0.865448f, 0.182725f}, {0.845561f, 0.887322f, 0.099702f}, {0.993248f, 0.906157f, 0.143936f},
};
// cividis (Nunez, Anderton and Renslow, PLOS ONE 13(7):e0199239, 2018): every 15th of the 256 published values.
constexpr Rgb cividis[] = {
    {0.000000f, 0.135112f, 0.304751f}, {0.000000f, 0.176082f, 0.407577f}, {0.087465f, 0.214879f, 0.437342f},
    {0.180503f, 0.256180f, 0.427299f}, {0.247605f, 0.296986f, 0.422917f}, {0.305886f, 0.337681f, 0.424512f},
    {0.359916f, 0.378641f, 0.431501f}, {0.411607f, 0.420145f, 0.443577f}, {0.461616f, 0.462405f, 0.461969f},
    {0.514226f, 0.505546f, 0.472640f}, {0.570607f, 0.549695f, 0.469593f}, {0.628576f, 0.595104f, 0.459641f},
    {0.687957f, 0.641966f, 0.442886f}, {0.748772f, 0.690470f, 0.418448f}, {0.811054f, 0.740801f, 0.385198f},
    {0.875057f, 0.793125f, 0.339685f}, {0.941147f, 0.847530f, 0.275815f}, {0.995737f, 0.909344f, 0.217772f},
};
// K. Moreland, "Diverging color maps for scientific visualization" (ISVC 2009): computed from its end colours
// (59, 76, 192) and (180, 4, 38) by its interpolation in Msh with an unsaturated middle of at least M = 88.
constexpr Rgb diverging[] = {
    {0.2314f, 0.2980f, 0.7529f}, {0.3050f, 0.4060f, 0.8444f}, {0.3838f, 0.5089f, 0.9169f},
    {0.4672f, 0.6042f, 0.9678f}, {0.5533f, 0.6886f, 0.9952f}, {0.6394f, 0.7594f, 0.9981f},
    {0.7223f, 0.8138f, 0.9765f}, {0.7987f, 0.8497f, 0.9317f}, {0.8654f, 0.8654f, 0.8654f},
    {0.9243f, 0.8275f, 0.7746f}, {0.9592f, 0.7699f, 0.6781f}, {0.9703f, 0.6945f, 0.5794f},
    {0.9584f, 0.6031f, 0.4817f}, {0.9244f, 0.4976f, 0.3877f}, {0.8696f, 0.3786f, 0.2997f},
    {0.7959f, 0.2415f, 0.2196f}, {0.7059f, 0.0157f, 0.1490f},
};

std::span<const Rgb> table(ColourMap map) {
    switch (map) {
    case ColourMap::viridis:
        return viridis;
    case ColourMap::cividis:
        return cividis;
    case ColourMap::diverging:
        break;
    }
    return diverging;
}

} // namespace

Rgba map_colour(ColourMap map, double t) {
    if (std::isnan(t))
        return {1.0f, 0.0f, 1.0f, 1.0f};
    const std::span<const Rgb> values = table(map);
    const double place = std::clamp(t, 0.0, 1.0) * static_cast<double>(values.size() - 1);
    const std::size_t low = std::min(static_cast<std::size_t>(place), values.size() - 2);
    const float share = static_cast<float>(place - static_cast<double>(low));
    Rgba colour{0, 0, 0, 1};
    for (std::size_t c = 0; c < 3; ++c)
        colour[c] = (1.0f - share) * values[low][c] + share * values[low + 1][c];
    return colour;
}

Rgba ColourScale::colour(double value) const {
    if (!(high > low))
        return map_colour(map, 0.5);
    double t = (value - low) / (high - low);
    if (middle)
        t = value < *middle ? 0.5 * (value - low) / (*middle - low)
                            : 0.5 + 0.5 * (value - *middle) / (high - *middle);
    return map_colour(map, reversed ? 1.0 - t : t);
}

std::vector<LegendTick> legend_ticks(const ColourScale& scale, int most) {
    FASCICLE_ASSERT(most >= 2);
    std::vector<LegendTick> ticks;
    const double range = scale.high - scale.low;
    if (!(range > 0) || !std::isfinite(range))
        return ticks;
    double step = std::pow(10.0, std::floor(std::log10(range / most)));
    for (const double multiple : {1.0, 2.0, 5.0, 10.0, 20.0})
        // `most` ticks span most - 1 steps; one more can fit only when both ends are round.
        if (std::floor(scale.high / (multiple * step) + 1e-9) -
                std::ceil(scale.low / (multiple * step) - 1e-9) + 1 <=
            most) {
            step *= multiple;
            break;
        }
    const int decimals = std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-9)), 0, 12);
    const double first = std::ceil(scale.low / step - 1e-9), last = std::floor(scale.high / step + 1e-9);
    for (double k = first; k <= last; k += 1.0) {
        const double value = k == 0.0 ? 0.0 : k * step;
        char label[400]; // to_chars: the user's locale must not change the decimal point
        const char* end =
            std::to_chars(label, label + sizeof label, value, std::chars_format::fixed, decimals).ptr;
        ticks.push_back({std::clamp((value - scale.low) / range, 0.0, 1.0), value,
                         std::string(static_cast<const char*>(label), end)});
    }
    return ticks;
}

} // namespace fascicle::view
