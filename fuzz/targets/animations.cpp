// Moving bodies: glTF, USD, point caches, series of files.

#include "fascicle/io/series_file.hpp"
#include "fuzz/check.hpp"
#include "fuzz/targets.hpp"
#include "io/formats/gltf_read.hpp"
#include "io/formats/gltf_write.hpp"
#include "io/formats/point_cache.hpp"
#include "io/formats/pvd.hpp"
#include "io/formats/usda_read.hpp"
#include "io/formats/usda_write.hpp"

#include <cmath>
#include <sstream>

namespace fascicle::fuzz {
namespace {

/// Frames that are looked at: a short file may have many.
constexpr std::size_t most_frames = 8;

/// Everything of it can be read, or is an Error.
void check_animation(const Animation& animation, const char* name) {
    FUZZ_CHECK(!animation.bodies.empty() && animation.frame_count() > 0);
    FUZZ_CHECK(animation.seconds.size() == animation.frame_count());
    FUZZ_CHECK(std::isfinite(animation.millimetres_per_unit) && animation.millimetres_per_unit >= 0);
    for (std::size_t k = 0; k < animation.frame_count(); ++k)
        FUZZ_CHECK(std::isfinite(animation.seconds[k]) &&
                   (k == 0 || (animation.frames[k] > animation.frames[k - 1] &&
                               animation.seconds[k] > animation.seconds[k - 1])));
    Points points;
    for (const AnimatedBody& body : animation.bodies) {
        const auto is_point = [&](int v) { return v >= 0 && static_cast<std::size_t>(v) < body.rest.size(); };
        for (const Tri& t : body.triangles)
            FUZZ_CHECK(is_point(t[0]) && is_point(t[1]) && is_point(t[2]));
        for (const std::vector<int>& line : body.lines)
            for (const int v : line)
                FUZZ_CHECK(is_point(v));
        for (std::size_t k = 0; k < std::min(animation.frame_count(), most_frames); ++k)
            reads(name, [&] {
                points_in_frame(body, k, points);
                FUZZ_CHECK(points.size() == body.rest.size());
                for (const Vec3& p : points)
                    FUZZ_CHECK(p.allFinite());
            });
    }
}

/// What is written of it is an animation, too, of as many bodies.
template <typename Write, typename Read>
void check_rewriting(const Animation& animation, const Write& write, const Read& read) {
    if (animation.frame_count() > most_frames)
        return;
    std::size_t bodies = 0;
    for (const AnimatedBody& body : animation.bodies)
        bodies += body.triangles.empty() && body.lines.empty() ? 0 : 1;
    std::ostringstream out;
    if (bodies == 0 || !reads({}, [&] { write(out); })) // what floats cannot hold is refused
        return;
    const Animation back = read(out.str());
    FUZZ_CHECK(back.bodies.size() == bodies);
}

std::string padded(std::string_view bytes, char with) {
    std::string out(bytes);
    out.resize((out.size() + 3) / 4 * 4, with);
    return out;
}

std::string word(std::size_t value) {
    std::string out;
    for (int i = 0; i < 4; ++i)
        out += static_cast<char>(value >> (8 * i));
    return out;
}

/// A .glb; what does not begin like one is its JSON and, after a line "@", its binary chunk.
std::string glb_of(std::string_view bytes) {
    if (bytes.starts_with("glTF"))
        return std::string(bytes);
    constexpr std::string_view mark = "\n@\n";
    const std::size_t cut = std::min(bytes.find(mark), bytes.size());
    const std::string json = padded(bytes.substr(0, cut), ' ');
    const std::string binary = padded(bytes.substr(std::min(cut + mark.size(), bytes.size())), '\0');
    return "glTF" + word(2) + word(28 + json.size() + binary.size()) + word(json.size()) + "JSON" + json +
           word(binary.size()) + std::string("BIN\0", 4) + binary;
}

void fuzz_glb(std::string_view bytes) {
    const std::string file = glb_of(bytes);
    Animation animation;
    if (!reads("fuzz.glb", [&] { animation = io::read_glb(file, "fuzz.glb"); }))
        return;
    check_animation(animation, "fuzz.glb");
    check_rewriting(
        animation, [&](std::ostream& out) { io::write_glb(out, animation, {}, "written"); },
        [](const std::string& text) { return io::read_glb(text, "written"); });
}

void fuzz_usda(std::string_view bytes) {
    Animation animation;
    if (!reads("fuzz.usda", [&] { animation = io::read_usda(bytes, "fuzz.usda"); }))
        return;
    check_animation(animation, "fuzz.usda");
    check_rewriting(
        animation, [&](std::ostream& out) { io::write_usda(out, animation); },
        [](const std::string& text) { return io::read_usda(text, "written"); });
}

void fuzz_point_cache(std::string_view bytes) {
    for (const auto& read : {io::read_pc2, io::read_mdd})
        reads("fuzz.pc2", [&] {
            const io::PointCache cache = read(bytes, "fuzz.pc2");
            Points points;
            for (std::size_t k = 0; k < std::min(cache.samples, most_frames); ++k) {
                cache.read(k, points, "fuzz.pc2");
                FUZZ_CHECK(points.size() == cache.points);
                for (const Vec3& p : points)
                    FUZZ_CHECK(p.allFinite());
            }
        });
}

void fuzz_series(std::string_view bytes) {
    looks_like_series(bytes);
    reads("fuzz.pvd", [&] {
        const auto series = parse_series(bytes, "fuzz.pvd");
        std::ostringstream out;
        io::write_pvd(out, series);
        const auto back = parse_series(out.str(), "written");
        FUZZ_CHECK(back.size() == series.size());
        for (std::size_t i = 0; i < series.size(); ++i)
            FUZZ_CHECK(back[i].first == series[i].first);
    });
}

} // namespace

std::vector<Target> animation_targets() {
    return {
        // glTF may say much with little: up to a million points and numbers are trusted to any file.
        {"animation_glb", fuzz_glb, 4 * kB, "mesh_glb", "animation_glb", 400, 400 * MB},
        {"animation_usda", fuzz_usda, 4 * kB, "mesh_usda", "mesh_usda", 400, MB},
        {"point_cache", fuzz_point_cache, 512, "point_cache", "point_cache", 100, MB},
        {"series", fuzz_series, 1 * kB, "series", "series", 400, MB},
    };
}

} // namespace fascicle::fuzz
