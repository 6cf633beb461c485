#pragma once
// Numbers to colours, and the colours of anatomy.

#include "render/draw_list.hpp"

#include <optional>
#include <string>
#include <vector>

namespace fascicle::view {

using render::Rgba;

/// viridis, cividis: even steps of lightness, readable with colour-vision deficiencies. diverging: blue over light grey
/// to red, for values on both sides of a middle.
enum class ColourMap { viridis, cividis, diverging };

/// sRGB colour of t in [0, 1], alpha 1. Values outside take the end's colour; NaN is magenta, a colour of no map.
Rgba map_colour(ColourMap map, double t);

/// A range of values spread over a map: low at 0, high at 1. middle: the value at 0.5, strictly between the two, linear
/// on both sides of it; nothing: half way. reversed: high at 0, low at 1.
struct ColourScale {
    ColourMap map = ColourMap::diverging;
    double low = 0.75;
    double high = 1.25;
    std::optional<double> middle = std::nullopt;
    bool reversed = false;

    Rgba colour(double value) const;
    bool operator==(const ColourScale&) const = default;
};

struct LegendTick {
    double position = 0; ///< 0 at the low end, 1 at the high end
    double value = 0;
    std::string label; ///< value with as many decimals as the step needs
};
/// Ticks at round values (1, 2 or 5 times a power of ten apart) inside the scale, at most `most` >= 2 of them.
/// Empty when low < high does not hold.
std::vector<LegendTick> legend_ticks(const ColourScale& scale, int most = 6);

/// Colours of anatomy atlases: red muscles, ivory bones, origins red, insertions blue.
namespace palette {
inline constexpr Rgba muscle{0.69f, 0.26f, 0.23f, 1.0f};
inline constexpr Rgba bone{0.91f, 0.87f, 0.77f, 1.0f};
inline constexpr Rgba origin{0.90f, 0.10f, 0.12f, 1.0f};
inline constexpr Rgba insertion{0.16f, 0.34f, 0.86f, 1.0f};
inline constexpr Rgba attachment{0.95f, 0.66f, 0.15f, 1.0f}; ///< kind unknown
inline constexpr Rgba joint_axis{0.10f, 0.45f, 0.30f, 1.0f};
inline constexpr Rgba line_muscle{0.10f, 0.24f, 0.45f, 1.0f};
inline constexpr Rgba fibre{0.55f, 0.12f, 0.14f, 1.0f};
inline constexpr Rgba fixed_vertex{0.10f, 0.62f, 0.30f, 1.0f};
inline constexpr Rgba cut_muscle{0.50f, 0.13f, 0.14f, 1.0f}; ///< flat, where a section plane cuts
inline constexpr Rgba cut_bone{0.83f, 0.72f, 0.52f, 1.0f};
inline constexpr Rgba no_value{0.56f, 0.59f, 0.63f, 1.0f}; ///< muscles that a colouring says nothing of
inline constexpr Rgba ghost{0.45f, 0.48f, 0.55f, 0.25f};
inline constexpr Rgba compared{0.00f, 0.45f, 0.70f, 0.45f}; ///< muscles of another run over those shown
} // namespace palette

} // namespace fascicle::view
