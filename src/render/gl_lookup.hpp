#pragma once
// How the GL function table is filled, without pulling in any GL header.

#include <functional>

namespace fascicle::render {

/// Address of a GL function of the current context by name, null when it does not have it:
/// glfwGetProcAddress of a window, OsmesaContext::lookup() without one.
using GlLookup = std::function<void*(const char* name)>;

/// Fills the table of gl_functions.hpp. The context must be current. Error naming the first missing function,
/// or the version found when it is older than GL 3.3.
void load_gl_functions(const GlLookup& lookup);

} // namespace fascicle::render
