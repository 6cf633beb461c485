#pragma once
// The GPU copy of one SurfaceItem. Arrays are uploaded again only when the item brings another array.

#include "render/draw_list.hpp"

namespace fascicle::render {

class MeshBuffer {
public:
    MeshBuffer();
    ~MeshBuffer();
    MeshBuffer(const MeshBuffer&) = delete;
    MeshBuffer& operator=(const MeshBuffer&) = delete;

    /// Brings the buffers up to the item's arrays; returns the number of arrays uploaded, 0 when nothing
    /// changed. Asserts that normals and colours, where given, have one entry per position and that indices
    /// are in range.
    /// Of live colours only what has changed since the last time is sent; that counts as one.
    int update(const SurfaceItem& item);
    /// Colours sent by the last update().
    std::size_t colours_sent() const { return colours_sent_; }
    /// Draws the triangles with the shader in use. Attributes: 0 position, 1 normal, 2 sRGB colour.
    void draw() const;

private:
    int update_live(const SurfaceItem& item);

    // Kept, not only compared: a freed array's address could come back with other content.
    std::shared_ptr<const std::vector<Vec3f>> positions_, normals_;
    std::shared_ptr<const std::vector<std::array<std::uint32_t, 3>>> triangles_;
    std::shared_ptr<const std::vector<Rgba>> colours_;
    std::shared_ptr<const LiveColours> live_;
    std::uint64_t live_revision_ = 0; ///< of what the GPU has
    std::size_t colours_sent_ = 0;
    std::size_t needed_vertices_ = 0; ///< largest index + 1
    unsigned vertex_array_ = 0;
    unsigned position_buffer_ = 0, normal_buffer_ = 0, colour_buffer_ = 0, index_buffer_ = 0;
};

} // namespace fascicle::render
