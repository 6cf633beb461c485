#include "render/gl_functions.hpp"

#include "fascicle/base/error.hpp"

namespace fascicle::render {

namespace gl {
#define FASCICLE_GL_DEFINE(type, name) type name = nullptr;
FASCICLE_GL_FUNCTIONS(FASCICLE_GL_DEFINE)
#undef FASCICLE_GL_DEFINE
} // namespace gl

void load_gl_functions(const GlLookup& lookup) {
    const auto find = [&](const char* name) {
        void* address = lookup(name);
        if (address == nullptr)
            throw_error("OpenGL", std::string("the driver has no function ") + name, "OpenGL 3.3 core");
        return address;
    };
#define FASCICLE_GL_FILL(type, name) gl::name = reinterpret_cast<type>(find("gl" #name));
    FASCICLE_GL_FUNCTIONS(FASCICLE_GL_FILL)
#undef FASCICLE_GL_FILL

    GLint major = 0, minor = 0;
    gl::GetIntegerv(GL_MAJOR_VERSION, &major);
    gl::GetIntegerv(GL_MINOR_VERSION, &minor);
    if (major * 10 + minor < 33)
        throw_error("OpenGL",
                    "version " + std::to_string(major) + "." + std::to_string(minor) + " is too old",
                    "3.3 or newer");
}

} // namespace fascicle::render
