#pragma once
// Small work on finished pictures.

#include "render/draw_list.hpp"

#include <vector>

namespace fascicle::render {

/// Share (0 to 1) of pixels of which any channel differs by more than `tolerance` (0 to 255). 1 when the
/// sizes differ, 0 for two empty pictures.
double differing_share(const Image& a, const Image& b, int tolerance);

/// The pictures side by side, top aligned, with `gap` pixels of `colour` (sRGB 0..1) between them and below
/// lower ones. No pictures: an empty one.
Image film_strip(const std::vector<Image>& images, int gap = 4, const Rgba& colour = {1, 1, 1, 1});

/// Mean of factor x factor blocks (a remainder at the right and bottom is dropped). factor >= 1; colours are
/// weighted by alpha, so that a transparent neighbour does not bleed in.
Image downsample(const Image& image, int factor);

} // namespace fascicle::render
