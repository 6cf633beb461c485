#include "fascicle/geometry/grid_codec.hpp"
#include "geometry/surface_oracles.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>
#include <cstring>
#include <set>

using namespace fascicle;

namespace {

constexpr std::size_t many = std::size_t{1} << 24;

DistanceGrid torus_grid() {
    DistanceGridOptions options;
    options.spacing = 0.5;
    options.saturation = 1.5;
    return {test::torus(6.0, 2.5), options};
}

bool same(const DistanceGrid& a, const DistanceGrid& b) {
    return a.nodes() == b.nodes() && a.spacing() == b.spacing() && a.saturation() == b.saturation() &&
           a.low() == b.low() && a.correction_max() == b.correction_max() &&
           a.correction_mean() == b.correction_mean() && a.bytes() == b.bytes() &&
           (a.bytes() == 0 || std::memcmp(a.data(), b.data(), a.bytes()) == 0);
}

} // namespace

TEST_CASE("a grid comes back from bytes to the last bit", "[geometry][grid_codec]") {
    const DistanceGrid grid = torus_grid();
    const std::string bytes = encode_grid(grid);
    CHECK(bytes.size() < grid.bytes() * 3 / 4); // saturated runs are short
    for (const int threads : {1, 3}) {
        const auto back = decode_grid(bytes, many, threads);
        REQUIRE(back);
        CHECK(same(*back, grid));
        test::Random random(1);
        for (int i = 0; i < 100; ++i) {
            const Vec3 p = random.in_box(Vec3::Constant(-9), Vec3::Constant(9));
            CHECK(back->sample(p).value == grid.sample(p).value);
            CHECK(back->sample(p).gradient == grid.sample(p).gradient);
        }
    }
    const DistanceGrid nothing(TriMesh{}, {});
    const auto back = decode_grid(encode_grid(nothing), many);
    REQUIRE(back);
    CHECK(same(*back, nothing));
    CHECK(back->value(Vec3::Zero()) == 8.0);
}

TEST_CASE("bytes that are no grid give none", "[geometry][grid_codec]") {
    const DistanceGrid grid = torus_grid();
    const std::string bytes = encode_grid(grid);
    const auto nodes = grid.bytes() / sizeof(float);
    CHECK(decode_grid(bytes, nodes));
    CHECK_FALSE(decode_grid(bytes, nodes - 1)); // larger than allowed
    CHECK_FALSE(decode_grid({}, many));
    CHECK_FALSE(decode_grid(std::string(1000, '\0'), many));
    for (std::size_t size = 0; size < bytes.size(); size += 97)
        CHECK_FALSE(decode_grid(bytes.substr(0, size), many));
    CHECK_FALSE(decode_grid(bytes + "more", many));
    // The checksum is the cache's; here it is enough that nothing damaged reads or writes out of bounds.
    test::Random random(7);
    int refused = 0;
    for (int i = 0; i < 400; ++i) {
        std::string damaged = bytes;
        const std::size_t range = i % 2 == 0 ? 600 : damaged.size();
        for (int k = 0; k < 3; ++k)
            damaged[random.index(range)] = static_cast<char>(random.index(256));
        refused += decode_grid(damaged, many, 1).has_value() ? 0 : 1;
    }
    CHECK(refused > 100);
}

TEST_CASE("keys of grids tell everything that matters, and not the threads", "[geometry][grid_codec]") {
    const TriMesh mesh = test::torus();
    DistanceGridOptions options;
    std::set<std::string> keys{grid_key(mesh, options)};
    options.threads = 7;
    CHECK(keys.count(grid_key(mesh, options)) == 1);
    DistanceGridOptions other = options;
    other.spacing = 1.0000001;
    keys.insert(grid_key(mesh, other));
    other = options;
    other.saturation = 9;
    keys.insert(grid_key(mesh, other));
    other = options;
    other.max_nodes = 1000;
    keys.insert(grid_key(mesh, other));
    TriMesh moved = mesh;
    moved.positions[3].y() = std::nextafter(moved.positions[3].y(), 1e9);
    keys.insert(grid_key(moved, options));
    TriMesh turned = mesh;
    std::swap(turned.triangles[5][0], turned.triangles[5][1]);
    keys.insert(grid_key(turned, options));
    TriMesh open = mesh;
    open.triangles.pop_back();
    keys.insert(grid_key(open, options));
    CHECK(keys.size() == 7);
}
