#include "render/drawing.hpp"

#include "fascicle/io/png.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace fascicle::test {
namespace fs = std::filesystem;

namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

render::Mat4f plain(const glm::mat4& m) {
    render::Mat4f values;
    std::copy_n(glm::value_ptr(m), 16, values.begin());
    return values;
}

} // namespace

render::SurfaceItem sphere(std::uint64_t id, const render::Rgba& colour, int rows) {
    std::vector<render::Vec3f> points;
    Triangles triangles;
    const int columns = 2 * rows;
    for (int row = 0; row <= rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const float polar = 3.14159265f * static_cast<float>(row) / static_cast<float>(rows);
            const float turn = 6.28318531f * static_cast<float>(column) / static_cast<float>(columns);
            points.push_back(
                {std::sin(polar) * std::cos(turn), std::cos(polar), -std::sin(polar) * std::sin(turn)});
        }
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const auto at = [&](int r, int c) {
                return static_cast<std::uint32_t>(r * columns + c % columns);
            };
            triangles.push_back({at(row, column), at(row + 1, column), at(row + 1, column + 1)});
            triangles.push_back({at(row, column), at(row + 1, column + 1), at(row, column + 1)});
        }
    render::SurfaceItem item;
    item.id = id;
    item.colour = colour;
    item.positions = std::make_shared<const std::vector<render::Vec3f>>(points);
    item.normals = item.positions; // on the unit sphere they are the same
    item.triangles = std::make_shared<const Triangles>(triangles);
    return item;
}

render::SurfaceItem rectangle(std::uint64_t id, const render::Rgba& colour, float w, float h) {
    render::SurfaceItem item;
    item.id = id;
    item.colour = colour;
    item.positions = std::make_shared<const std::vector<render::Vec3f>>(
        std::vector<render::Vec3f>{{-w, -h, 0}, {w, -h, 0}, {w, h, 0}, {-w, h, 0}});
    item.normals = std::make_shared<const std::vector<render::Vec3f>>(4, render::Vec3f{0, 0, 1});
    item.triangles = std::make_shared<const Triangles>(Triangles{{0, 1, 2}, {0, 2, 3}});
    return item;
}

render::Mat4f translation(float x, float y, float z, float scale) {
    return plain(glm::scale(glm::translate(glm::mat4(1.0f), glm::vec3(x, y, z)), glm::vec3(scale)));
}

render::CameraPose front_camera(float aspect, bool orthographic) {
    const float half = 200.0f / 90.0f / 2.0f;
    render::CameraPose camera;
    camera.eye = {0, 0, 4};
    camera.view = plain(glm::translate(glm::mat4(1.0f), glm::vec3(0, 0, -4)));
    camera.projection =
        plain(orthographic ? glm::ortho(-half * aspect, half * aspect, -half, half, 0.5f, 20.0f)
                           : glm::perspective(2.0f * std::atan(half / 4.0f), aspect, 0.5f, 20.0f));
    return camera;
}

std::array<int, 4> pixel(const render::Image& image, int x, int y) {
    REQUIRE((x >= 0 && y >= 0 && x < image.width && y < image.height));
    const std::size_t at = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                                static_cast<std::size_t>(x));
    return {image.rgba[at], image.rgba[at + 1], image.rgba[at + 2], image.rgba[at + 3]};
}

render::Image draw(render::SceneRenderer& renderer, const render::DrawList& list, int width, int height,
                   int supersampling) {
    const render::OffscreenTarget target(width, height, supersampling);
    renderer.draw(list, target);
    return target.read_back();
}

void check_golden(const render::Image& image, const std::string& name) {
    const fs::path golden = fs::path(FASCICLE_SOURCE_DIR) / "tests/golden" / (name + ".png");
    const char* update = std::getenv("FASCICLE_UPDATE_GOLDEN");
    if (update != nullptr && std::string(update) == "1") {
        write_png(golden, image.width, image.height, image.rgba.data());
        WARN("golden picture written: " << golden.string());
        return;
    }
    INFO("golden picture " << golden.string() << "; FASCICLE_UPDATE_GOLDEN=1 writes it anew");
    const PngImage stored = read_png(golden);
    const double share = render::differing_share(image, {stored.width, stored.height, stored.rgba}, 8);
    if (share > 0.01) {
        const fs::path seen = fs::temp_directory_path() / ("fascicle_golden_" + name + ".png");
        write_png(seen, image.width, image.height, image.rgba.data());
        UNSCOPED_INFO("picture drawn now: " << seen.string());
    }
    CHECK(share <= 0.01);
}

} // namespace fascicle::test
