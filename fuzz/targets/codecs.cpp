// Bytes of our own making: carried meshes, base64, distance grids, the cache, pictures.

#include "fascicle/geometry/grid_codec.hpp"
#include "fascicle/io/disk_cache.hpp"
#include "fascicle/io/png.hpp"
#include "fuzz/check.hpp"
#include "fuzz/targets.hpp"
#include "io/base64.hpp"
#include "io/mesh_codec.hpp"

#include <cmath>
#include <cstring>

namespace fascicle::fuzz {
namespace {

void fuzz_mesh_codec(std::string_view bytes) {
    reads("fuzz.json", [&] {
        const io::Json json = io::parse_json_object(bytes, "fuzz.json");
        MeshData data;
        data.mesh = io::read_carried_mesh(io::JsonFields(json, "fuzz.json", ""));
        check_mesh_data(data);
        const io::Json again = io::carried_mesh_json(data.mesh);
        const TriMesh back = io::read_carried_mesh(io::JsonFields(again, "written", ""));
        FUZZ_CHECK(back.triangles == data.mesh.triangles &&
                   back.positions.size() == data.mesh.positions.size());
        FUZZ_CHECK(back.positions.empty() || std::memcmp(back.positions.data(), data.mesh.positions.data(),
                                                         back.positions.size() * sizeof(Vec3)) == 0);
    });
}

void fuzz_base64(std::string_view bytes) {
    std::string out, again;
    if (io::decode_base64(bytes, out)) {
        FUZZ_CHECK(out.size() <= bytes.size() / 4 * 3);
        FUZZ_CHECK(io::decode_base64(io::encode_base64(out), again) && again == out);
    }
    again.clear();
    FUZZ_CHECK(io::decode_base64(io::encode_base64(bytes), again) && again == bytes);
}

void fuzz_grid(std::string_view bytes) {
    constexpr std::size_t most = 4096;
    const std::optional<DistanceGrid> grid = decode_grid(bytes, most);
    if (!grid)
        return;
    FUZZ_CHECK(grid->values().size() <= most);
    for (const double at : {-1e300, -1.0, 0.0, 0.4, 3.0, 1e300, std::nan("")}) {
        const Vec3 p = grid->low() + Vec3(at, 0.3 * at, 0.1);
        grid->sample(p);
        grid->value(p);
    }
    const std::string written = encode_grid(*grid);
    const std::optional<DistanceGrid> back = decode_grid(written, most);
    FUZZ_CHECK(back && back->values().size() == grid->values().size());
    FUZZ_CHECK(encode_grid(*back) == written);
}

void fuzz_cache_entry(std::string_view bytes) {
    const std::string key(32, 'a');
    if (const auto content = DiskCache::content(key, bytes))
        FUZZ_CHECK(content->size() < bytes.size());
    FUZZ_CHECK(!DiskCache::content("no key", bytes));
}

void fuzz_png(std::string_view bytes) {
    PngImage image;
    if (!reads("fuzz.png", [&] { image = decode_png(bytes, "fuzz.png"); }))
        return;
    FUZZ_CHECK(image.width > 0 && image.height > 0);
    FUZZ_CHECK(image.rgba.size() ==
               4 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    if (image.rgba.size() > 100'000)
        return; // packing it takes long
    const PngImage back = decode_png(encode_png(image.width, image.height, image.rgba.data()), "written");
    FUZZ_CHECK(back.width == image.width && back.height == image.height && back.rgba == image.rgba);
}

} // namespace

std::vector<Target> codec_targets() {
    return {
        {"mesh_codec", fuzz_mesh_codec, 1 * kB, "mesh_codec", "mesh_codec", 400, MB},
        {"base64", fuzz_base64, 256, "", "base64", 100, MB},
        {"grid", fuzz_grid, 2 * kB, "", "grid", 400, MB},
        {"cache_entry", fuzz_cache_entry, 256, "", "cache_entry", 100, MB},
        // Deflate packs up to 1032 bytes into one, and a pixel of one bit becomes four bytes.
        {"png", fuzz_png, 1 * kB, "png", "png", 2 * 32 * 1032 * 8, MB},
    };
}

} // namespace fascicle::fuzz
