#pragma once
// What is to be drawn, as plain data. render draws it and knows no scene; view makes it and knows no GL.
// Colours are sRGB in 0..1; lengths in scene units; arrays are shared and immutable so that caches can
// compare pointers.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace fascicle::render {

using Vec3f = std::array<float, 3>;
using Rgba = std::array<float, 4>;
/// Column-major 4x4, as OpenGL and GLM store it.
using Mat4f = std::array<float, 16>;

/// Vertex colours that change while someone looks: the one array that is not immutable. Whoever changes entries raises the
/// revision and says which, so that a renderer sends just those to the GPU. Changed and drawn on one thread.
struct LiveColours {
    struct Change {
        std::uint64_t revision; ///< that the change made
        std::size_t first, count;
    };
    static constexpr std::size_t kept_changes = 512;

    std::vector<Rgba> colours;
    std::uint64_t revision = 1;
    std::vector<Change> changes;  ///< the latest, ascending; one that missed older ones takes the whole array
    std::uint64_t known_from = 1; ///< changes after this revision are all in the list
};

/// A triangle surface. normals and colours: one per vertex or null. Without normals every triangle is flat.
/// With vertex colours, of `colour` only alpha counts: it multiplies theirs.
struct SurfaceItem {
    std::uint64_t id = 0; ///< stable per object: the renderer keeps GPU buffers under it
    std::shared_ptr<const std::vector<Vec3f>> positions;
    std::shared_ptr<const std::vector<Vec3f>> normals;
    std::shared_ptr<const std::vector<std::array<std::uint32_t, 3>>> triangles;
    std::shared_ptr<const std::vector<Rgba>> vertex_colours; ///< null: colour
    std::shared_ptr<const LiveColours> live_colours;         ///< in place of vertex_colours
    Rgba colour{0.8f, 0.8f, 0.8f, 1.0f};                     ///< alpha < 1 is drawn after the opaque items
    Mat4f model{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    float gloss = 0.2f;     ///< 0 chalk, 1 wet
    bool wireframe = false; ///< edges over the surface
    /// Flat colour of what a section plane cuts open (DrawList::section); alpha 0: left open, for what is no solid. The cut is as
    /// opaque as the surface.
    Rgba cap{0, 0, 0, 0};
};

/// Separate line segments: points 2k and 2k+1 make a segment.
struct LineItem {
    std::shared_ptr<const std::vector<Vec3f>> points;
    std::shared_ptr<const std::vector<Rgba>> point_colours; ///< null: colour
    Rgba colour{0, 0, 0, 1};
    float width_px = 1.0f;
    bool on_top = false; ///< drawn over everything (axes, rings)
};

/// Camera of a picture. View space: x right, y up, looking along -z; projection: OpenGL's, depth -1 (near)
/// to 1.
struct CameraPose {
    Mat4f view{};
    Mat4f projection{};
    Vec3f eye{};
};

struct DrawList {
    std::vector<SurfaceItem> surfaces;
    std::vector<LineItem> lines;
    CameraPose camera;
    /// Alpha below 1 leaves the picture's background transparent.
    Rgba background_top{0.93f, 0.94f, 0.96f, 1};
    Rgba background_bottom{0.78f, 0.81f, 0.85f, 1};
    /// (n, d) in scene coordinates: only what has n . p + d >= 0 is drawn, of surfaces and lines. n is not zero.
    std::optional<std::array<float, 4>> section;
    /// Reach of ambient occlusion, scene units: opaque surfaces are darker where others are nearer than this. 0: off.
    float occlusion_radius = 0.0f;
};

/// An 8-bit sRGB picture, rows from the top, 4 bytes a pixel (RGBA).
struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;
};

} // namespace fascicle::render
