#include "render/occlusion_pass.hpp"

#include "render/gl_functions.hpp"

#include <algorithm>

namespace fascicle::render {

namespace {

constexpr int most_pixels = 600000; ///< of a picture whose every pixel gets its own occlusion

const char* const vertex_glsl = R"(
void main() {
    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
)";

// For n samples v_i around a point of normal n, of radius r: with f = max(0, 1 - |v|^2 / r^2),
//   visible = 1 - 2 strength r / samples * sum f^3 max(0, v . n - bias) / (|v|^2 + epsilon),
// the obscurance of McGuire, Mara, Luebke, "Scalable ambient obscurance" (HPG 2012), eq. 1, dimensionless. Samples lie on a spiral,
// turned by one of 16 angles in each pixel of 4x4, which the blur averages. The bias keeps the flat triangles of a coarse surface
// from darkening each other.
const char* const occlusion_glsl = R"(
uniform sampler2D depth;
uniform int supersampling;
uniform vec2 size;       // of this picture
uniform vec4 projection; // P00, P11, P22, P32
uniform int orthographic;
uniform float radius;
out vec4 result;

const int samples = 12;
const float strength = 1.3;

float view_z(ivec2 pixel) {
    float ndc = 2.0 * texelFetch(depth, pixel * supersampling, 0).r - 1.0;
    return orthographic != 0 ? (ndc - projection.w) / projection.z : -projection.w / (projection.z + ndc);
}
vec3 place(ivec2 pixel) {
    float z = view_z(pixel);
    vec2 ndc = 2.0 * (vec2(pixel) + 0.5) / size - 1.0;
    return vec3(ndc / projection.xy * (orthographic != 0 ? 1.0 : -z), z);
}
void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    if (texelFetch(depth, pixel * supersampling, 0).r >= 1.0) {
        result = vec4(1.0);
        return;
    }
    vec3 here = place(pixel);
    float reach = radius * projection.y * 0.5 * size.y / (orthographic != 0 ? 1.0 : -here.z); // pixels
    reach = min(reach, 0.2 * size.y);
    if (reach < 1.5) {
        result = vec4(1.0);
        return;
    }
    ivec2 last = ivec2(size) - 1;
    vec3 left = here - place(max(pixel - ivec2(1, 0), ivec2(0))), right = place(min(pixel + ivec2(1, 0), last)) - here;
    vec3 down = here - place(max(pixel - ivec2(0, 1), ivec2(0))), up = place(min(pixel + ivec2(0, 1), last)) - here;
    vec3 dx = pixel.x == 0 || (pixel.x < last.x && abs(right.z) < abs(left.z)) ? right : left;
    vec3 dy = pixel.y == 0 || (pixel.y < last.y && abs(up.z) < abs(down.z)) ? up : down;
    vec3 n = normalize(cross(dx, dy));
    float turn = float((pixel.x & 3) * 4 + (pixel.y & 3)) * 0.39269908 + 0.7 * float((pixel.x ^ pixel.y) & 1);
    float r2 = radius * radius;
    float sum = 0.0;
    for (int i = 0; i < samples; ++i) {
        float share = (float(i) + 0.5) / float(samples), angle = 2.3999632 * float(i) + turn;
        ivec2 other = pixel + ivec2(round(share * reach * vec2(cos(angle), sin(angle))));
        if (any(lessThan(other, ivec2(0))) || any(greaterThan(other, last)))
            continue;
        vec3 v = place(other) - here;
        float vv = dot(v, v), f = max(0.0, 1.0 - vv / r2);
        sum += f * f * f * max(0.0, dot(v, n) - 0.04 * radius) / (vv + 0.0025 * r2);
    }
    float visible = clamp(1.0 - 2.0 * strength * radius / float(samples) * sum, 0.0, 1.0);
    result = vec4(vec3(visible), 1.0);
}
)";

// 4x4, the period of the spiral's turns; pixels of another depth do not count.
const char* const blur_glsl = R"(
uniform sampler2D raw;
uniform sampler2D depth;
uniform int supersampling;
uniform vec2 size;
uniform vec4 projection;
uniform int orthographic;
uniform float radius;
out vec4 result;
float view_z(ivec2 pixel) {
    float ndc = 2.0 * texelFetch(depth, pixel * supersampling, 0).r - 1.0;
    return orthographic != 0 ? (ndc - projection.w) / projection.z : -projection.w / (projection.z + ndc);
}
void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy), last = ivec2(size) - 1;
    float z = view_z(pixel), sum = 0.0, weights = 0.0;
    for (int y = -2; y < 2; ++y)
        for (int x = -2; x < 2; ++x) {
            ivec2 other = clamp(pixel + ivec2(x, y), ivec2(0), last);
            float weight = max(0.02, 1.0 - abs(view_z(other) - z) * 2.0 / radius);
            sum += weight * texelFetch(raw, other, 0).r;
            weights += weight;
        }
    result = vec4(vec3(sum / weights), 1.0);
}
)";

const char* const multiply_glsl = R"(
uniform sampler2D blurred;
uniform vec2 size; // of the samples
out vec4 result;
void main() {
    result = vec4(vec3(texture(blurred, gl_FragCoord.xy / size).r), 1.0);
}
)";

} // namespace

OcclusionPass::OcclusionPass()
    : occlusion_("occlusion", vertex_glsl, occlusion_glsl), blur_("occlusion blur", vertex_glsl, blur_glsl),
      multiply_("occlusion multiply", vertex_glsl, multiply_glsl) {
    gl::GenVertexArrays(1, &empty_array_);
}

OcclusionPass::~OcclusionPass() {
    release_buffers();
    gl::DeleteVertexArrays(1, &empty_array_);
}

void OcclusionPass::release_buffers() {
    gl::DeleteFramebuffers(2, framebuffers_);
    gl::DeleteTextures(2, textures_);
    width_ = height_ = 0;
}

void OcclusionPass::make_buffers(int width, int height) {
    if (width == width_ && height == height_)
        return;
    release_buffers();
    gl::GenTextures(2, textures_);
    gl::GenFramebuffers(2, framebuffers_);
    for (int i = 0; i < 2; ++i) {
        gl::BindTexture(GL_TEXTURE_2D, textures_[i]);
        gl::TexImage2D(GL_TEXTURE_2D, 0, GL_R8, width, height, 0, GL_RED, GL_UNSIGNED_BYTE, nullptr);
        gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
        gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
        gl::BindFramebuffer(GL_FRAMEBUFFER, framebuffers_[i]);
        gl::FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, textures_[i], 0);
        require_complete_framebuffer("ambient occlusion");
    }
    width_ = width;
    height_ = height;
}

void OcclusionPass::apply(const OffscreenTarget& target, const Mat4f& projection, float radius) {
    // Half the resolution in large pictures: shade is smooth, and the cost is then that of a small one.
    const int step = target.width() * target.height() > most_pixels ? 2 : 1;
    const int width = std::max(1, target.width() / step), height = std::max(1, target.height() / step);
    const int supersampling = target.supersampling() * step;
    make_buffers(width, height);
    gl::Disable(GL_DEPTH_TEST);
    gl::Disable(GL_BLEND);
    gl::Disable(GL_STENCIL_TEST);
    gl::BindVertexArray(empty_array_);
    const auto describe = [&](Shader& shader) {
        shader.set("depth", 0);
        shader.set("supersampling", supersampling);
        shader.set("size", static_cast<float>(width), static_cast<float>(height));
        shader.set("projection", Rgba{projection[0], projection[5], projection[10], projection[14]});
        shader.set("orthographic", projection[15] != 0.0f ? 1 : 0);
        shader.set("radius", radius);
    };
    gl::ActiveTexture(GL_TEXTURE0);
    gl::BindTexture(GL_TEXTURE_2D, target.depth_texture());
    gl::Viewport(0, 0, width, height);
    gl::BindFramebuffer(GL_FRAMEBUFFER, framebuffers_[0]);
    occlusion_.use();
    describe(occlusion_);
    gl::DrawArrays(GL_TRIANGLES, 0, 3);

    gl::BindFramebuffer(GL_FRAMEBUFFER, framebuffers_[1]);
    gl::ActiveTexture(GL_TEXTURE1);
    gl::BindTexture(GL_TEXTURE_2D, textures_[0]);
    blur_.use();
    describe(blur_);
    blur_.set("raw", 1);
    gl::DrawArrays(GL_TRIANGLES, 0, 3);
    gl::BindTexture(GL_TEXTURE_2D, 0);

    target.bind();
    gl::ActiveTexture(GL_TEXTURE0);
    gl::BindTexture(GL_TEXTURE_2D, textures_[1]);
    gl::Enable(GL_BLEND);
    gl::BlendFuncSeparate(GL_ZERO, GL_SRC_COLOR, GL_ZERO, GL_ONE);
    multiply_.use();
    multiply_.set("blurred", 0);
    multiply_.set("size", static_cast<float>(width * supersampling),
                  static_cast<float>(height * supersampling));
    gl::DrawArrays(GL_TRIANGLES, 0, 3);
    gl::Disable(GL_BLEND);
    gl::BindTexture(GL_TEXTURE_2D, 0);
}

} // namespace fascicle::render
