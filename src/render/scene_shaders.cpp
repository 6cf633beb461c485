#include "render/scene_shaders.hpp"

namespace fascicle::render {

// One triangle that covers the picture, made from the vertex number.
const char* const background_vertex_glsl = R"(
out float height;
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    height = 0.5 * corner.y + 0.5;
    gl_Position = vec4(corner, 0.0, 1.0);
}
)";

// Colours are mixed as sRGB values, which is what looks even. The pixel-sized pattern (half an 8-bit step)
// hides the bands that 8 bits would show. Written with colour times alpha, as the blending of everything
// after it does.
const char* const background_fragment_glsl = R"(
uniform vec4 top;
uniform vec4 bottom;
in float height;
out vec4 result;
void main() {
    vec4 colour = mix(bottom, top, clamp(height, 0.0, 1.0));
    float pattern = fract(52.9829189 * fract(dot(floor(gl_FragCoord.xy), vec2(0.06711056, 0.00583715)))) - 0.5;
    result = vec4(clamp(colour.rgb + pattern / 255.0, 0.0, 1.0) * colour.a, colour.a);
}
)";

std::string surface_vertex_glsl() {
    return R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 vertex_colour;
uniform mat4 model_view;
uniform mat4 projection;
uniform mat3 normal_matrix;
uniform vec4 section; // in view space; (0, 0, 0, 1) without one
out float gl_ClipDistance[1];
out Surface {
    vec3 position;
    vec3 normal;
    vec4 colour; // linear
} to_next;
vec3 to_linear(vec3 c) {
    return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(vec3(0.04045), c));
}
void main() {
    vec4 seen = model_view * vec4(position, 1.0);
    to_next.position = seen.xyz;
    to_next.normal = normal_matrix * normal;
    to_next.colour = vec4(to_linear(vertex_colour.rgb), vertex_colour.a);
    gl_Position = projection * seen;
    gl_ClipDistance[0] = dot(section, seen);
}
)";
}

// Distances to the three edges in pixels, as in Baerentzen et al., "Single-pass wireframe rendering"
// (SIGGRAPH 2006 sketches). A triangle that reaches behind the eye has no useful screen positions and gets no
// edges.
std::string surface_geometry_glsl() {
    return R"(
layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;
uniform vec2 viewport;
uniform vec4 section;
out float gl_ClipDistance[1];
in Surface {
    vec3 position;
    vec3 normal;
    vec4 colour;
} from_vertex[];
out Wired {
    vec3 position;
    vec3 normal;
    vec4 colour;
} to_next;
noperspective out vec3 edge_distance;
void main() {
    vec3 heights = vec3(0.0);
    bool visible = gl_in[0].gl_Position.w > 0.0 && gl_in[1].gl_Position.w > 0.0 && gl_in[2].gl_Position.w > 0.0;
    if (visible) {
        vec2 p[3];
        for (int i = 0; i < 3; ++i)
            p[i] = 0.5 * viewport * gl_in[i].gl_Position.xy / gl_in[i].gl_Position.w;
        vec2 a = p[2] - p[1], b = p[0] - p[2], c = p[1] - p[0];
        float doubled_area = abs(b.x * c.y - b.y * c.x);
        heights = doubled_area / max(vec3(length(a), length(b), length(c)), vec3(1e-6));
    }
    for (int i = 0; i < 3; ++i) {
        to_next.position = from_vertex[i].position;
        to_next.normal = from_vertex[i].normal;
        to_next.colour = from_vertex[i].colour;
        edge_distance = visible ? vec3(0.0) : vec3(1e6);
        if (visible)
            edge_distance[i] = heights[i];
        gl_Position = gl_in[i].gl_Position;
        gl_ClipDistance[0] = dot(section, vec4(from_vertex[i].position, 1.0));
        EmitVertex();
    }
    EndPrimitive();
}
)";
}

// Lighting fixed to the camera, in view space (x right, y up, z to the eye), computed on linear values:
//  sky/ground light by the normal's height, a wide key light from the upper left, a cool fill from the right,
//  a rim; "wrap" lets the key light reach a little past 90 degrees (soft tissue), redder than green and blue;
//  "shade" darkens where the surface turns away, standing in for ambient occlusion.
// sRGB conversions: IEC 61966-2-1.
std::string surface_fragment_glsl(bool wireframe) {
    const std::string head = wireframe ? R"(
#define WIREFRAME 1
in Wired {
    vec3 position;
    vec3 normal;
    vec4 colour;
} from;
noperspective in vec3 edge_distance;
uniform float edge_width;
)"
                                       : R"(
in Surface {
    vec3 position;
    vec3 normal;
    vec4 colour;
} from;
)";
    return head + R"(
uniform float gloss;
uniform float opacity;
uniform int has_normals;
uniform int orthographic;
uniform float front_sign;
uniform vec4 cap; // alpha 0: the inside is lit
out vec4 result;

vec3 to_srgb(vec3 c) {
    c = clamp(c, 0.0, 1.0);
    return mix(c * 12.92, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(vec3(0.0031308), c));
}
// Bends values above 0.75 over towards 1, so that bright places keep their form.
vec3 shoulder(vec3 c) {
    vec3 over = max(c - 0.75, 0.0);
    return min(c, 0.75) + 0.25 * over / (0.25 + over);
}

void main() {
    vec3 eye = orthographic != 0 ? vec3(0.0, 0.0, 1.0) : normalize(-from.position);
    // A vertex without triangles or a collapsed fan has a zero normal: the face's own one serves there too.
    vec3 face = cross(dFdx(from.position), dFdy(from.position));
    vec3 n;
    bool front = (gl_FrontFacing ? 1.0 : -1.0) * front_sign > 0.0;
    if (has_normals != 0 && dot(from.normal, from.normal) > 0.0)
        n = normalize(from.normal) * (front ? 1.0 : -1.0);
    else
        n = normalize(face + vec3(0.0, 0.0, 1e-30));

    // Where a cut solid is not closed its inside shows: as flat as the cut, so that it does not look like another surface.
    if (!front && cap.a > 0.0) {
        result = vec4(cap.rgb, from.colour.a * opacity);
        return;
    }
    float facing = clamp(dot(n, eye), 0.0, 1.0);
    vec3 key = normalize(vec3(-0.45, 0.62, 0.70));
    vec3 fill = normalize(vec3(0.80, 0.05, 0.45));
    vec3 wrap = vec3(0.30, 0.22, 0.20);
    vec3 diffuse = clamp((dot(n, key) + wrap) / (1.0 + wrap), 0.0, 1.0);
    diffuse *= diffuse;
    float fill_light = clamp(dot(n, fill), 0.0, 1.0);
    vec3 hemisphere = mix(vec3(0.20, 0.17, 0.16), vec3(0.40, 0.42, 0.45), 0.5 + 0.5 * n.y);
    float shade = mix(0.55, 1.0, smoothstep(0.0, 0.75, facing));
    vec3 light = (hemisphere + vec3(0.80, 0.78, 0.74) * diffuse + vec3(0.13, 0.15, 0.18) * fill_light) * shade;

    vec3 albedo = from.colour.rgb;
    if (!front)
        albedo = mix(albedo, vec3(dot(albedo, vec3(0.2126, 0.7152, 0.0722))), 0.5) * 0.6; // the inside
    float power = mix(12.0, 90.0, gloss);
    float highlight = pow(clamp(dot(n, normalize(key + eye)), 0.0, 1.0), power) * gloss * 0.45;
    float edge_on = (1.0 - facing) * (1.0 - facing);
    float rim = edge_on * edge_on * 0.22 * (0.4 + 0.6 * clamp(n.y + 0.3, 0.0, 1.0));
    vec3 colour = albedo * light + highlight + rim * mix(vec3(0.75, 0.82, 0.95), albedo, 0.4);
    // Glass-like: a transparent surface is denser where it is seen edge-on.
    float alpha = from.colour.a * opacity;
    alpha += (1.0 - alpha) * alpha * 1.2 * edge_on;
    vec3 shown = to_srgb(shoulder(colour));
#ifdef WIREFRAME
    float nearest = min(edge_distance.x, min(edge_distance.y, edge_distance.z));
    float line = 1.0 - smoothstep(edge_width * 0.5 - 0.5, edge_width * 0.5 + 0.5, nearest);
    shown = mix(shown, shown * 0.25, line * 0.85);
    alpha = max(alpha, line * 0.6);
#endif
    result = vec4(shown, min(alpha, 1.0));
}
)";
}

// A segment becomes a rectangle of its width plus half a pixel of soft border, in pixels, after being cut at
// the near plane. Instance data: the two ends; six vertices by number.
const char* const line_vertex_glsl = R"(
layout(location = 0) in vec3 start;
layout(location = 1) in vec3 end;
layout(location = 2) in vec4 start_colour;
layout(location = 3) in vec4 end_colour;
uniform mat4 view;
uniform mat4 projection;
uniform vec2 viewport;
uniform float width;
uniform float lift; // towards the eye, in pixels
uniform vec4 section; // in view space; (0, 0, 0, 1) without one
out float gl_ClipDistance[1];
noperspective out vec2 place;
noperspective out float extent;
out vec4 colour;
void main() {
    vec4 seen_a = view * vec4(start, 1.0), seen_b = view * vec4(end, 1.0);
    vec4 a = projection * seen_a, b = projection * seen_b;
    float kept_a = dot(section, seen_a), kept_b = dot(section, seen_b);
    gl_ClipDistance[0] = 1.0;
    vec4 colour_a = start_colour, colour_b = end_colour;
    float near_a = a.z + a.w, near_b = b.z + b.w;
    if (near_a < 0.0 && near_b < 0.0) {
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
        return;
    }
    if (near_a < 0.0 || near_b < 0.0) {
        float t = near_a / (near_a - near_b);
        vec4 cut = mix(a, b, t);
        vec4 cut_colour = mix(colour_a, colour_b, t);
        float cut_kept = mix(kept_a, kept_b, t);
        if (near_a < 0.0) {
            a = cut;
            colour_a = cut_colour;
            kept_a = cut_kept;
        } else {
            b = cut;
            colour_b = cut_colour;
            kept_b = cut_kept;
        }
    }
    vec2 pa = 0.5 * viewport * a.xy / a.w, pb = 0.5 * viewport * b.xy / b.w;
    float size = length(pb - pa);
    vec2 along = size > 1e-4 ? (pb - pa) / size : vec2(1.0, 0.0);
    vec2 across = vec2(-along.y, along.x);
    float reach = 0.5 * width + 0.5;
    int corner = gl_VertexID < 3 ? gl_VertexID : 6 - gl_VertexID; // 0 1 2, 3 2 1
    bool at_end = corner == 1 || corner == 3;
    float side = corner >= 2 ? 1.0 : -1.0;
    vec4 base = at_end ? b : a;
    vec2 offset = reach * ((at_end ? 1.0 : -1.0) * along + side * across);
    place = vec2(at_end ? size + reach : -reach, side * reach);
    extent = size;
    colour = at_end ? colour_b : colour_a;
    gl_ClipDistance[0] = at_end ? kept_b : kept_a;
    // Depth of the place `lift` pixels nearer: a pixel spans 2 w / (P11 height) units at clip w (w is 1 when
    // orthographic). z and w are linear in the distance along the view axis, with slopes P22 and P23 (row, column 2).
    float nearer = min(lift * 2.0 * base.w / (projection[1][1] * viewport.y), 0.5 * base.w);
    float lifted = (base.z + projection[2][2] * nearer) / (base.w + projection[2][3] * nearer);
    gl_Position = vec4(base.xy + offset * 2.0 / viewport * base.w, max(lifted, -1.0) * base.w, base.w);
}
)";

const char* const line_fragment_glsl = R"(
uniform float width;
noperspective in vec2 place;
noperspective in float extent;
in vec4 colour;
out vec4 result;
void main() {
    float outside = max(0.0, max(-place.x, place.x - extent));
    float distance = length(vec2(outside, place.y));
    float cover = clamp(0.5 * width + 0.5 - distance, 0.0, 1.0);
    if (cover <= 0.0)
        discard;
    result = vec4(colour.rgb, colour.a * cover);
}
)";

// A square of the section plane, where the stencil says that a solid is cut. Flat, with faint stripes as in drawings, so that it
// is told from a surface also without colour.
const char* const cap_vertex_glsl = R"(
uniform mat4 projection;
uniform vec4 centre; // view space
uniform vec4 right;
uniform vec4 up;
void main() {
    vec2 corner = vec2((gl_VertexID & 1) == 0 ? -1.0 : 1.0, (gl_VertexID & 2) == 0 ? -1.0 : 1.0);
    gl_Position = projection * vec4(centre.xyz + corner.x * right.xyz + corner.y * up.xyz, 1.0);
}
)";

const char* const cap_fragment_glsl = R"(
uniform vec4 cap;
uniform float pixel_scale;
out vec4 result;
void main() {
    float place = mod(gl_FragCoord.x + gl_FragCoord.y, 9.0 * pixel_scale) / pixel_scale;
    float stripe = 1.0 - smoothstep(0.7, 1.3, abs(place - 4.5));
    result = vec4(cap.rgb * (1.0 - 0.14 * stripe), cap.a);
}
)";

} // namespace fascicle::render
