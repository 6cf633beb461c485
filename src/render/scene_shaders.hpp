#pragma once
// GLSL of scene_renderer. Shader puts the "#version" line in front.

#include <string>

namespace fascicle::render {

extern const char* const background_vertex_glsl;
extern const char* const background_fragment_glsl;
extern const char* const line_vertex_glsl;
extern const char* const line_fragment_glsl;
extern const char* const cap_vertex_glsl;
extern const char* const cap_fragment_glsl;
std::string surface_vertex_glsl();
/// wireframe: for the program with the geometry stage, which hands on the distances to the triangle's edges.
std::string surface_fragment_glsl(bool wireframe);
std::string surface_geometry_glsl();

} // namespace fascicle::render
