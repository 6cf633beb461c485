#include "render/imgui_renderer.hpp"

#include "fascicle/base/assert.hpp"
#include "render/gl_functions.hpp"

#include <cstddef>
#include <imgui.h>

namespace fascicle::render {

namespace {

// Positions are in interface units from the display's top left corner. ImGui's colours are sRGB and stay as
// they are.
const char* const vertex_glsl = R"(
layout(location = 0) in vec2 position;
layout(location = 1) in vec2 uv;
layout(location = 2) in vec4 colour;
uniform vec2 scale;
uniform vec2 shift;
out vec2 place;
out vec4 tint;
void main() {
    place = uv;
    tint = colour;
    gl_Position = vec4(position * scale + shift, 0.0, 1.0);
}
)";

const char* const fragment_glsl = R"(
uniform sampler2D picture;
in vec2 place;
in vec4 tint;
out vec4 result;
void main() {
    result = tint * texture(picture, place);
}
)";

} // namespace

void* texture_id(unsigned texture) {
    return reinterpret_cast<void*>(static_cast<std::uintptr_t>(texture));
}

ImguiRenderer::ImguiRenderer() : shader_("interface", vertex_glsl, fragment_glsl) {
    ImGuiIO& io = ImGui::GetIO();
    io.BackendRendererName = "fascicle";
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset; // indices have 16 bits
    gl::GenVertexArrays(1, &vertex_array_);
    gl::GenBuffers(1, &vertex_buffer_);
    gl::GenBuffers(1, &index_buffer_);
    gl::BindVertexArray(vertex_array_);
    gl::BindBuffer(GL_ARRAY_BUFFER, vertex_buffer_);
    gl::BindBuffer(GL_ELEMENT_ARRAY_BUFFER, index_buffer_);
    const auto attribute = [](GLuint index, GLint components, GLenum type, GLboolean normalised,
                              std::size_t offset) {
        gl::EnableVertexAttribArray(index);
        gl::VertexAttribPointer(index, components, type, normalised, sizeof(ImDrawVert),
                                reinterpret_cast<const void*>(offset));
    };
    attribute(0, 2, GL_FLOAT, GL_FALSE, offsetof(ImDrawVert, pos));
    attribute(1, 2, GL_FLOAT, GL_FALSE, offsetof(ImDrawVert, uv));
    attribute(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(ImDrawVert, col));
    gl::BindVertexArray(0);
}

ImguiRenderer::~ImguiRenderer() {
    release_font_texture();
    gl::DeleteBuffers(1, &vertex_buffer_);
    gl::DeleteBuffers(1, &index_buffer_);
    gl::DeleteVertexArrays(1, &vertex_array_);
}

void ImguiRenderer::release_font_texture() {
    if (font_texture_ == 0)
        return;
    if (ImGui::GetCurrentContext() != nullptr && ImGui::GetIO().Fonts->TexID == texture_id(font_texture_))
        ImGui::GetIO().Fonts->SetTexID(nullptr);
    gl::DeleteTextures(1, &font_texture_);
    font_texture_ = 0;
}

void ImguiRenderer::new_frame() {
    ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
    // A rebuilt atlas has lost its texture id.
    if (font_texture_ != 0 && fonts.TexID == texture_id(font_texture_))
        return;
    release_font_texture();
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    fonts.GetTexDataAsRGBA32(&pixels, &width, &height);
    gl::GenTextures(1, &font_texture_);
    gl::BindTexture(GL_TEXTURE_2D, font_texture_);
    gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl::PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl::TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    fonts.SetTexID(texture_id(font_texture_));
    fonts.ClearTexData(); // the GPU has it now
}

void ImguiRenderer::draw(const ImDrawData* data) {
    if (data == nullptr || !data->Valid)
        return;
    const int width = static_cast<int>(data->DisplaySize.x * data->FramebufferScale.x);
    const int height = static_cast<int>(data->DisplaySize.y * data->FramebufferScale.y);
    if (width <= 0 || height <= 0)
        return;

    const auto set_up = [&] {
        gl::Viewport(0, 0, width, height);
        gl::Disable(GL_CULL_FACE);
        gl::Disable(GL_DEPTH_TEST);
        gl::Disable(GL_FRAMEBUFFER_SRGB);
        gl::PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
        gl::ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        gl::Enable(GL_SCISSOR_TEST);
        gl::Enable(GL_BLEND);
        gl::BlendEquation(GL_FUNC_ADD);
        gl::BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
        gl::ActiveTexture(GL_TEXTURE0);
        shader_.use();
        shader_.set("picture", 0);
        const float scale_x = 2.0f / data->DisplaySize.x, scale_y = -2.0f / data->DisplaySize.y;
        shader_.set("scale", scale_x, scale_y);
        shader_.set("shift", -1.0f - data->DisplayPos.x * scale_x, 1.0f - data->DisplayPos.y * scale_y);
        gl::BindVertexArray(vertex_array_);
        gl::BindBuffer(GL_ARRAY_BUFFER, vertex_buffer_);
    };
    set_up();

    for (int n = 0; n < data->CmdListsCount; ++n) {
        const ImDrawList& list = *data->CmdLists[n];
        gl::BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(list.VtxBuffer.size_in_bytes()),
                       list.VtxBuffer.Data, GL_STREAM_DRAW);
        gl::BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(list.IdxBuffer.size_in_bytes()),
                       list.IdxBuffer.Data, GL_STREAM_DRAW);
        for (const ImDrawCmd& command : list.CmdBuffer) {
            if (command.UserCallback == ImDrawCallback_ResetRenderState) {
                set_up();
                continue;
            }
            if (command.UserCallback != nullptr) {
                command.UserCallback(&list, &command);
                continue;
            }
            const float left = (command.ClipRect.x - data->DisplayPos.x) * data->FramebufferScale.x;
            const float top = (command.ClipRect.y - data->DisplayPos.y) * data->FramebufferScale.y;
            const float right = (command.ClipRect.z - data->DisplayPos.x) * data->FramebufferScale.x;
            const float bottom = (command.ClipRect.w - data->DisplayPos.y) * data->FramebufferScale.y;
            if (right <= left || bottom <= top)
                continue;
            gl::Scissor(static_cast<int>(left), static_cast<int>(static_cast<float>(height) - bottom),
                        static_cast<int>(right - left), static_cast<int>(bottom - top));
            const auto texture = static_cast<unsigned>(reinterpret_cast<std::uintptr_t>(command.GetTexID()));
            gl::BindTexture(GL_TEXTURE_2D, texture);
            gl::DrawElementsBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(command.ElemCount),
                                       GL_UNSIGNED_SHORT,
                                       reinterpret_cast<const void*>(command.IdxOffset * sizeof(ImDrawIdx)),
                                       static_cast<GLint>(command.VtxOffset));
        }
    }
    static_assert(sizeof(ImDrawIdx) == 2, "GL_UNSIGNED_SHORT above");
    gl::Disable(GL_SCISSOR_TEST);
    gl::Disable(GL_BLEND);
    gl::BindVertexArray(0);
}

} // namespace fascicle::render
