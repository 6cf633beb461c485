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
    int update(const SurfaceItem& item);
    /// Draws the triangles with the shader in use. Attributes: 0 position, 1 normal, 2 sRGB colour.
    void draw() const;

private:
    // Kept, not only compared: a freed array's address could come back with other content.
    std::shared_ptr<const std::vector<Vec3f>> positions_, normals_;
    std::shared_ptr<const std::vector<std::array<std::uint32_t, 3>>> triangles_;
    std::shared_ptr<const std::vector<Rgba>> colours_;
    std::size_t needed_vertices_ = 0; ///< largest index + 1
    unsigned vertex_array_ = 0;
    unsigned position_buffer_ = 0, normal_buffer_ = 0, colour_buffer_ = 0, index_buffer_ = 0;
};

} // namespace fascicle::render
