#include "render/scene_renderer.hpp"

#include "fascicle/base/assert.hpp"
#include "render/gl_functions.hpp"
#include "render/scene_shaders.hpp"

#include <algorithm>
#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <numeric>

namespace fascicle::render {

namespace {

// A hidden object keeps its buffers for this many pictures, so that blinking something costs no upload.
constexpr std::uint64_t keep_for_draws = 120;

glm::mat4 matrix(const Mat4f& m) {
    return glm::make_mat4(m.data());
}

Rgba vector(const glm::vec4& v) {
    return {v.x, v.y, v.z, v.w};
}

bool transparent(const SurfaceItem& item) {
    return item.colour[3] < 1.0f;
}

bool empty(const SurfaceItem& item) {
    return item.positions == nullptr || item.triangles == nullptr || item.triangles->empty();
}

} // namespace

struct SceneRenderer::Pass {
    glm::mat4 view, projection;
    float width, height, pixel_scale;
    bool orthographic;
    glm::vec4 section; ///< in view space
    bool cut, caps;    ///< there is a section; there is a stencil for its caps
};

SceneRenderer::SceneRenderer()
    : background_("background", background_vertex_glsl, background_fragment_glsl),
      surface_("surface", surface_vertex_glsl(), surface_fragment_glsl(false)),
      wired_surface_("wireframe", surface_vertex_glsl(), surface_fragment_glsl(true),
                     surface_geometry_glsl()),
      line_("line", line_vertex_glsl, line_fragment_glsl), cap_("cap", cap_vertex_glsl, cap_fragment_glsl) {
    gl::GenVertexArrays(1, &empty_array_);
    gl::GenVertexArrays(1, &line_array_);
    gl::GenBuffers(1, &line_points_);
    gl::GenBuffers(1, &line_colours_);
}

SceneRenderer::~SceneRenderer() {
    gl::DeleteBuffers(1, &line_points_);
    gl::DeleteBuffers(1, &line_colours_);
    gl::DeleteVertexArrays(1, &line_array_);
    gl::DeleteVertexArrays(1, &empty_array_);
}

void SceneRenderer::draw(const DrawList& list, const OffscreenTarget& target, float pixel_scale) {
    target.bind();
    draw(list, target.width() * target.supersampling(), target.height() * target.supersampling(),
         pixel_scale * static_cast<float>(target.supersampling()), &target);
    target.resolve();
}

void SceneRenderer::draw(const DrawList& list, int width, int height, float pixel_scale) {
    draw(list, width, height, pixel_scale, nullptr);
}

void SceneRenderer::draw(const DrawList& list, int width, int height, float pixel_scale,
                         const OffscreenTarget* target) {
    ++draws_;
    uploads_ = 0;
    colours_sent_ = 0;
    const glm::mat4 projection = matrix(list.camera.projection);
    // The last row of a perspective matrix is (0, 0, -1, 0), of an orthographic one (0, 0, 0, 1).
    const glm::mat4 view = matrix(list.camera.view);
    glm::vec4 section(0, 0, 0, 1);
    if (list.section) // planes go by the inverse transpose
        section = glm::transpose(glm::inverse(view)) * glm::make_vec4(list.section->data());
    const Pass pass{view,
                    projection,
                    static_cast<float>(width),
                    static_cast<float>(height),
                    pixel_scale,
                    projection[3][3] != 0.0f,
                    section,
                    list.section.has_value(),
                    list.section.has_value() && target != nullptr};

    gl::Viewport(0, 0, width, height);
    gl::Disable(GL_SCISSOR_TEST);
    gl::Disable(GL_CULL_FACE);
    gl::Disable(GL_FRAMEBUFFER_SRGB); // the shaders convert
    gl::Disable(GL_BLEND);
    gl::Disable(GL_DEPTH_TEST);
    gl::Disable(GL_STENCIL_TEST);
    gl::Disable(GL_CLIP_DISTANCE0);
    gl::PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    gl::ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl::DepthMask(GL_TRUE);
    gl::Clear(GL_DEPTH_BUFFER_BIT);
    gl::BindVertexArray(empty_array_);
    background_.use();
    background_.set("top", list.background_top);
    background_.set("bottom", list.background_bottom);
    gl::DrawArrays(GL_TRIANGLES, 0, 3);

    gl::Enable(GL_DEPTH_TEST);
    gl::DepthFunc(GL_LEQUAL);
    gl::BlendEquation(GL_FUNC_ADD);
    if (pass.cut)
        gl::Enable(GL_CLIP_DISTANCE0);
    for (const SurfaceItem& item : list.surfaces)
        if (!empty(item) && !transparent(item)) {
            draw_surface(item, pass);
            draw_cap(item, pass);
        }
    if (target != nullptr && list.occlusion_radius > 0.0f) {
        gl::Disable(GL_CLIP_DISTANCE0);
        occlusion_.apply(*target, list.camera.projection, list.occlusion_radius);
        gl::Enable(GL_DEPTH_TEST);
        if (pass.cut)
            gl::Enable(GL_CLIP_DISTANCE0);
    }
    gl::BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl::Enable(GL_BLEND);
    for (const LineItem& item : list.lines)
        if (!item.on_top)
            draw_lines(item, pass);
    draw_transparent(list, pass);
    gl::Disable(GL_DEPTH_TEST);
    for (const LineItem& item : list.lines)
        if (item.on_top)
            draw_lines(item, pass);
    gl::Disable(GL_BLEND);
    gl::Disable(GL_CLIP_DISTANCE0);
    gl::BindVertexArray(0);
    forget_unused();
}

// Each transparent item first writes its depth, then its colour at that depth: only its nearest layer shows,
// whatever the order of its triangles. Items go from far to near by the depth of their centres.
void SceneRenderer::draw_transparent(const DrawList& list, const Pass& pass) {
    std::vector<std::pair<float, const SurfaceItem*>> order;
    for (const SurfaceItem& item : list.surfaces) {
        if (empty(item) || !transparent(item) || item.colour[3] <= 0.0f || item.positions->empty())
            continue;
        const Vec3f& middle = entry_of(item).centre;
        const glm::vec4 centre =
            pass.view * matrix(item.model) * glm::vec4(middle[0], middle[1], middle[2], 1.0f);
        order.emplace_back(centre.z, &item);
    }
    std::stable_sort(order.begin(), order.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [depth, item] : order) {
        gl::ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        draw_surface(*item, pass);
        gl::ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        gl::DepthFunc(GL_EQUAL);
        draw_surface(*item, pass);
        gl::DepthFunc(GL_LEQUAL);
        draw_cap(*item, pass);
    }
}

/// Its buffers, brought up to date, and the ball around its box.
SceneRenderer::Entry& SceneRenderer::entry_of(const SurfaceItem& item) {
    Entry& entry = entries_[item.id];
    if (!entry.buffer)
        entry.buffer = std::make_unique<MeshBuffer>();
    entry.last_drawn = draws_;
    uploads_ += entry.buffer->update(item);
    colours_sent_ += entry.buffer->colours_sent();
    if (entry.positions != item.positions) {
        glm::vec3 low(0.0f), high(0.0f);
        bool first = true;
        for (const Vec3f& p : *item.positions) {
            const glm::vec3 place(p[0], p[1], p[2]);
            low = first ? place : glm::min(low, place);
            high = first ? place : glm::max(high, place);
            first = false;
        }
        const glm::vec3 middle = 0.5f * (low + high);
        entry.centre = {middle.x, middle.y, middle.z};
        entry.radius = 0.5f * glm::length(high - low);
        entry.positions = item.positions;
    }
    return entry;
}

// The plane is inside a solid where, along the ray of a pixel, the faces beyond it do not come in pairs: the stencil counts those seen
// from behind up and those seen from the front down, whatever hides them. Then a square of the plane is drawn where it is not zero.
void SceneRenderer::draw_cap(const SurfaceItem& item, const Pass& pass) {
    if (!pass.caps || item.cap[3] <= 0.0f)
        return;
    const Entry& entry = entry_of(item);
    const glm::mat4 model = matrix(item.model);
    glm::vec3 centre(pass.view * model * glm::vec4(entry.centre[0], entry.centre[1], entry.centre[2], 1.0f));
    const glm::vec3 normal(pass.section);
    const float stretch = std::max({glm::length(model[0]), glm::length(model[1]), glm::length(model[2])}),
                length = glm::length(normal), radius = 1.01f * entry.radius * stretch;
    const float distance = (glm::dot(normal, centre) + pass.section.w) / length;
    if (!(std::abs(distance) < radius))
        return;
    centre -= distance / length * normal;

    gl::Enable(GL_STENCIL_TEST);
    gl::StencilMask(0xff);
    gl::ClearStencil(0);
    gl::Clear(GL_STENCIL_BUFFER_BIT);
    gl::StencilFunc(GL_ALWAYS, 0, 0xff);
    gl::StencilOpSeparate(GL_FRONT, GL_KEEP, GL_KEEP, GL_DECR_WRAP);
    gl::StencilOpSeparate(GL_BACK, GL_KEEP, GL_KEEP, GL_INCR_WRAP);
    gl::ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    gl::DepthMask(GL_FALSE);
    gl::DepthFunc(GL_ALWAYS);
    draw_surface(item, pass);

    gl::ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl::DepthMask(GL_TRUE);
    gl::DepthFunc(GL_LEQUAL);
    gl::StencilFunc(GL_NOTEQUAL, 0, 0xff);
    gl::StencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    gl::Disable(GL_CLIP_DISTANCE0);
    const glm::vec3 n = normal / length;
    const glm::vec3 across =
        radius *
        glm::normalize(glm::cross(n, std::abs(n.x) < 0.7f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0)));
    const glm::vec3 other = glm::cross(n, across);
    gl::BindVertexArray(empty_array_);
    cap_.use();
    cap_.set_mat4("projection", glm::value_ptr(pass.projection));
    cap_.set("centre", vector(glm::vec4(centre, 1.0f)));
    cap_.set("right", vector(glm::vec4(across, 0.0f)));
    cap_.set("up", vector(glm::vec4(other, 0.0f)));
    cap_.set("cap", Rgba{item.cap[0], item.cap[1], item.cap[2], item.cap[3] * item.colour[3]});
    cap_.set("pixel_scale", pass.pixel_scale);
    gl::DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    gl::Disable(GL_STENCIL_TEST);
    gl::Enable(GL_CLIP_DISTANCE0);
}

void SceneRenderer::draw_surface(const SurfaceItem& item, const Pass& pass) {
    Entry& entry = entry_of(item);
    const glm::mat4 model_view = pass.view * matrix(item.model);
    const glm::mat3 linear(model_view);
    const float determinant = glm::determinant(linear);
    const glm::mat3 normal_matrix = determinant != 0.0f ? glm::transpose(glm::inverse(linear)) : linear;
    Shader& shader = item.wireframe ? wired_surface_ : surface_;
    shader.use();
    shader.set_mat4("model_view", glm::value_ptr(model_view));
    shader.set_mat4("projection", glm::value_ptr(pass.projection));
    shader.set_mat3("normal_matrix", glm::value_ptr(normal_matrix));
    shader.set("gloss", std::clamp(item.gloss, 0.0f, 1.0f));
    shader.set("opacity", item.vertex_colours || item.live_colours ? item.colour[3] : 1.0f);
    shader.set("has_normals", item.normals ? 1 : 0);
    shader.set("orthographic", pass.orthographic ? 1 : 0);
    shader.set("section", vector(pass.section));
    shader.set("cap", pass.cut ? item.cap : Rgba{0, 0, 0, 0});
    shader.set("front_sign", determinant < 0.0f ? -1.0f : 1.0f); // a mirrored copy keeps its outside
    if (item.wireframe) {
        shader.set("viewport", pass.width, pass.height);
        shader.set("edge_width", pass.pixel_scale);
    }
    gl::VertexAttrib4f(2, item.colour[0], item.colour[1], item.colour[2], item.colour[3]);
    entry.buffer->draw();
}

void SceneRenderer::draw_lines(const LineItem& item, const Pass& pass) {
    if (item.points == nullptr || item.points->size() < 2)
        return;
    FASCICLE_ASSERT(item.points->size() % 2 == 0);
    FASCICLE_ASSERT(item.point_colours == nullptr || item.point_colours->size() == item.points->size());

    // Lines are few and change often: they are sent for every picture.
    gl::BindVertexArray(line_array_);
    const auto bind_pairs = [](const auto& array, unsigned buffer, GLuint first, GLint components) {
        const auto stride = static_cast<GLsizei>(2 * sizeof(array[0]));
        gl::BindBuffer(GL_ARRAY_BUFFER, buffer);
        gl::BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(array.size() * sizeof(array[0])),
                       array.data(), GL_STREAM_DRAW);
        for (GLuint end = 0; end < 2; ++end) {
            const auto offset = reinterpret_cast<const void*>(end * sizeof(array[0]));
            gl::VertexAttribPointer(first + end, components, GL_FLOAT, GL_FALSE, stride, offset);
            gl::EnableVertexAttribArray(first + end);
            gl::VertexAttribDivisor(first + end, 1);
        }
    };
    bind_pairs(*item.points, line_points_, 0, 3);
    if (item.point_colours) {
        bind_pairs(*item.point_colours, line_colours_, 2, 4);
    } else {
        for (const GLuint attribute : {2u, 3u}) {
            gl::DisableVertexAttribArray(attribute);
            gl::VertexAttrib4f(attribute, item.colour[0], item.colour[1], item.colour[2], item.colour[3]);
        }
    }
    line_.use();
    line_.set_mat4("view", glm::value_ptr(pass.view));
    line_.set_mat4("projection", glm::value_ptr(pass.projection));
    line_.set("viewport", pass.width, pass.height);
    line_.set("width", std::max(item.width_px, 0.0f) * pass.pixel_scale);
    line_.set("section", vector(pass.section));
    line_.set("lift", 2.0f * pass.pixel_scale); // a line on a surface wins over it
    gl::DrawArraysInstanced(GL_TRIANGLES, 0, 6, static_cast<GLsizei>(item.points->size() / 2));
}

void SceneRenderer::forget_unused() {
    for (auto it = entries_.begin(); it != entries_.end();)
        it = draws_ - it->second.last_drawn > keep_for_draws ? entries_.erase(it) : std::next(it);
}

} // namespace fascicle::render
