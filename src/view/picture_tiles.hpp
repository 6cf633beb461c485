#pragma once
// A large picture in parts: each is quick to draw, and the whole may be larger than what the driver can draw at once.

#include "render/draw_list.hpp"

namespace fascicle::view {

/// A part of a picture, pixels from its upper left corner.
struct PictureTile {
    int x = 0, y = 0, width = 0, height = 0;
};

/// Parts of nearly the same size, at most `most` pixels a side, row by row; together the whole picture, without overlap.
std::vector<PictureTile> picture_tiles(int width, int height, int most);

/// The list as the tile shows it, when drawn to a picture of the tile's size with `margin` more pixels on each side. Lines keep
/// their widths, and the background goes on from tile to tile.
render::DrawList list_of_tile(render::DrawList list, int width, int height, const PictureTile& tile,
                              int margin);

} // namespace fascicle::view
