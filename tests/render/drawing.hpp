#pragma once
// Shared by the drawing tests: meshes for the GPU, pixel access, golden pictures.

#include "render/image.hpp"
#include "render/osmesa_context.hpp"
#include "render/scene_renderer.hpp"

#include <string>

namespace fascicle::test {

/// A sphere of radius 1 with exact normals, rows x 2 rows quads.
render::SurfaceItem sphere(std::uint64_t id, const render::Rgba& colour, int rows = 24);
/// A rectangle in the plane z = 0, from (-w, -h) to (w, h), two triangles, seen from +z.
render::SurfaceItem rectangle(std::uint64_t id, const render::Rgba& colour, float w, float h);
render::Mat4f translation(float x, float y, float z, float scale = 1.0f);

/// Looks along -z from (0, 0, 4) at the origin, 90 pixels of view height per unit in a square picture of 200
/// pixels.
render::CameraPose front_camera(float aspect = 1.0f, bool orthographic = false);

/// Colour of one pixel, x from the left, y from the top.
std::array<int, 4> pixel(const render::Image& image, int x, int y);
/// Share of pixels that `predicate(colour)` accepts.
template <class Predicate>
double share(const render::Image& image, Predicate&& predicate) {
    int count = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            count += predicate(pixel(image, x, y)) ? 1 : 0;
    return static_cast<double>(count) / (static_cast<double>(image.width) * image.height);
}

/// Draws the list in memory.
render::Image draw(render::SceneRenderer& renderer, const render::DrawList& list, int width, int height,
                   int supersampling = 2);

/// Compares with tests/golden/<name>.png: at most 1 % of the pixels may differ by more than 8 of 255 in a
/// channel (edges move by a hair between Mesa versions). On failure the picture is left in the temporary
/// folder and named. With FASCICLE_UPDATE_GOLDEN=1 in the environment the golden picture is written instead:
/// look at it, then commit it.
void check_golden(const render::Image& image, const std::string& name);

} // namespace fascicle::test
