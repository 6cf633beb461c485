#include "view/picture_tiles.hpp"

#include "fascicle/base/assert.hpp"

namespace fascicle::view {

namespace {

/// Begin of part i of n of a length.
int cut(int length, int i, int n) {
    return static_cast<int>(static_cast<long long>(length) * i / n);
}

render::Rgba mixed(const render::Rgba& bottom, const render::Rgba& top, double share) {
    render::Rgba colour;
    for (std::size_t c = 0; c < 4; ++c)
        colour[c] = bottom[c] + static_cast<float>(share) * (top[c] - bottom[c]);
    return colour;
}

} // namespace

std::vector<PictureTile> picture_tiles(int width, int height, int most) {
    FASCICLE_ASSERT(width >= 1 && height >= 1 && most >= 1);
    const int columns = (width + most - 1) / most, rows = (height + most - 1) / most;
    std::vector<PictureTile> tiles;
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c) {
            const int x = cut(width, c, columns), y = cut(height, r, rows);
            tiles.push_back({x, y, cut(width, c + 1, columns) - x, cut(height, r + 1, rows) - y});
        }
    return tiles;
}

render::DrawList list_of_tile(render::DrawList list, int width, int height, const PictureTile& tile,
                              int margin) {
    // Normalised device coordinates of the whole picture run from -1 to 1; the tile's part, x_c +- x_h, is stretched to that:
    // x' = (x - x_c w) / x_h in homogeneous coordinates; y likewise, upwards.
    const double w = width, h = height;
    const double x0 = tile.x - margin, x1 = tile.x + tile.width + margin;
    const double y0 = tile.y - margin, y1 = tile.y + tile.height + margin;
    const double x_centre = (x0 + x1) / w - 1, x_half = (x1 - x0) / w;
    const double y_centre = 1 - (y0 + y1) / h, y_half = (y1 - y0) / h;
    render::Mat4f& p = list.camera.projection;
    for (std::size_t column = 0; column < 4; ++column) {
        float* c = p.data() + 4 * column;
        const double last = static_cast<double>(c[3]);
        c[0] = static_cast<float>((static_cast<double>(c[0]) - x_centre * last) / x_half);
        c[1] = static_cast<float>((static_cast<double>(c[1]) - y_centre * last) / y_half);
    }
    const render::Rgba top = list.background_top, bottom = list.background_bottom;
    list.background_top = mixed(bottom, top, 1 - y0 / h);
    list.background_bottom = mixed(bottom, top, 1 - y1 / h);
    return list;
}

} // namespace fascicle::view
