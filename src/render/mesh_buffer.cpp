#include "render/mesh_buffer.hpp"

#include "fascicle/base/assert.hpp"
#include "render/gl_functions.hpp"

#include <algorithm>

namespace fascicle::render {

namespace {

template <class Array>
void upload_attribute(const Array& array, unsigned buffer, GLuint attribute, GLint components) {
    gl::BindBuffer(GL_ARRAY_BUFFER, buffer);
    gl::BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(array.size() * sizeof(array[0])), array.data(),
                   GL_DYNAMIC_DRAW);
    gl::VertexAttribPointer(attribute, components, GL_FLOAT, GL_FALSE, 0, nullptr);
    gl::EnableVertexAttribArray(attribute);
}

} // namespace

MeshBuffer::MeshBuffer() {
    gl::GenVertexArrays(1, &vertex_array_);
    unsigned buffers[4];
    gl::GenBuffers(4, buffers);
    position_buffer_ = buffers[0];
    normal_buffer_ = buffers[1];
    colour_buffer_ = buffers[2];
    index_buffer_ = buffers[3];
}

MeshBuffer::~MeshBuffer() {
    const unsigned buffers[4] = {position_buffer_, normal_buffer_, colour_buffer_, index_buffer_};
    gl::DeleteBuffers(4, buffers);
    gl::DeleteVertexArrays(1, &vertex_array_);
}

int MeshBuffer::update(const SurfaceItem& item) {
    FASCICLE_ASSERT(item.positions != nullptr && item.triangles != nullptr);
    const std::size_t vertices = item.positions->size();
    FASCICLE_ASSERT(item.normals == nullptr || item.normals->size() == vertices);
    FASCICLE_ASSERT(item.vertex_colours == nullptr || item.vertex_colours->size() == vertices);
    FASCICLE_ASSERT(item.live_colours == nullptr || item.live_colours->colours.size() == vertices);

    int uploads = 0;
    gl::BindVertexArray(vertex_array_);
    if (item.positions != positions_) {
        upload_attribute(*item.positions, position_buffer_, 0, 3);
        positions_ = item.positions;
        ++uploads;
    }
    if (item.normals != normals_) {
        if (item.normals)
            upload_attribute(*item.normals, normal_buffer_, 1, 3);
        else
            gl::DisableVertexAttribArray(1);
        normals_ = item.normals;
        ++uploads;
    }
    colours_sent_ = 0;
    if (item.live_colours != nullptr) {
        uploads += update_live(item);
    } else if (live_ != nullptr || item.vertex_colours != colours_) {
        if (item.vertex_colours) {
            upload_attribute(*item.vertex_colours, colour_buffer_, 2, 4);
            colours_sent_ = item.vertex_colours->size();
        } else {
            gl::DisableVertexAttribArray(2);
        }
        colours_ = item.vertex_colours;
        live_ = nullptr;
        ++uploads;
    }
    if (item.triangles != triangles_) {
        std::size_t needed = 0;
        for (const auto& triangle : *item.triangles)
            for (const std::uint32_t index : triangle)
                needed = std::max(needed, std::size_t{index} + 1);
        needed_vertices_ = needed;
        gl::BindBuffer(GL_ELEMENT_ARRAY_BUFFER, index_buffer_);
        gl::BufferData(GL_ELEMENT_ARRAY_BUFFER,
                       static_cast<GLsizeiptr>(item.triangles->size() * sizeof(item.triangles->front())),
                       item.triangles->data(), GL_STATIC_DRAW);
        triangles_ = item.triangles;
        ++uploads;
    }
    FASCICLE_ASSERT(needed_vertices_ <= vertices);
    return uploads;
}

int MeshBuffer::update_live(const SurfaceItem& item) {
    const LiveColours& live = *item.live_colours;
    if (live_ == item.live_colours && live_revision_ == live.revision)
        return 0;
    if (live_ != item.live_colours || live_revision_ < live.known_from) {
        upload_attribute(live.colours, colour_buffer_, 2, 4);
        colours_sent_ = live.colours.size();
    } else {
        gl::BindBuffer(GL_ARRAY_BUFFER, colour_buffer_);
        for (const LiveColours::Change& change : live.changes)
            if (change.revision > live_revision_) {
                gl::BufferSubData(GL_ARRAY_BUFFER, static_cast<GLintptr>(change.first * sizeof(Rgba)),
                                  static_cast<GLsizeiptr>(change.count * sizeof(Rgba)),
                                  live.colours.data() + change.first);
                colours_sent_ += change.count;
            }
    }
    live_ = item.live_colours;
    colours_ = nullptr;
    live_revision_ = live.revision;
    return 1;
}

void MeshBuffer::draw() const {
    gl::BindVertexArray(vertex_array_);
    gl::DrawElements(GL_TRIANGLES, static_cast<GLsizei>(triangles_->size() * 3), GL_UNSIGNED_INT, nullptr);
}

} // namespace fascicle::render
