#pragma once
// A chart as pixels, drawn without a graphics context.

#include "view/chart.hpp"

#include <filesystem>

namespace fascicle::view {

/// The same picture as chart_svg(), `scale` (1 to 4) pixels for one of its, lines and text drawn at that size. Error when none
/// of the fonts (default_imgui_fonts()) is there: a chart without text is none.
render::Image chart_image(const Chart& chart, int width, int height, double scale = 1, bool dark = false);

} // namespace fascicle::view
