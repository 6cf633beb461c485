#pragma once
// Draws what ImGui laid out, with our own GL table, so that panels come out the same in a window and in
// memory.

#include "render/shader.hpp"

struct ImDrawData;

namespace fascicle::render {

class ImguiRenderer {
public:
    /// A GL context and an ImGui context must be current. Tells ImGui that vertex offsets are understood.
    ImguiRenderer();
    ~ImguiRenderer();
    ImguiRenderer(const ImguiRenderer&) = delete;
    ImguiRenderer& operator=(const ImguiRenderer&) = delete;

    /// Before each ImGui::NewFrame(): sends the font atlas to the GPU when it is new or was rebuilt.
    void new_frame();
    /// Draws into the bound framebuffer over what is there; null or empty data draws nothing. Texture ids of
    /// ImGui::Image are GL texture names (see texture_id()). Data: ImGui::GetDrawData() after
    /// ImGui::Render().
    void draw(const ImDrawData* data);

private:
    void release_font_texture();

    Shader shader_;
    unsigned vertex_array_ = 0, vertex_buffer_ = 0, index_buffer_ = 0, font_texture_ = 0;
};

/// A GL texture name as ImGui::Image wants it.
void* texture_id(unsigned texture);

} // namespace fascicle::render
