#include "fascicle/base/error.hpp"
#include "render/gl_functions.hpp"
#include "render/osmesa_context.hpp"
#include "render/shader.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::render;
using Catch::Matchers::Contains;

TEST_CASE("A missing OSMesa library is named in the error", "[render][osmesa_context]") {
    CHECK_THROWS_WITH(OsmesaContext({"libNoSuchMesa.so.1", "libNoneEither.so"}),
                      Contains("libNoSuchMesa.so.1") && Contains("libNoneEither.so") &&
                          Contains("libosmesa6"));
}

TEST_CASE("A library without the entry points is refused", "[render][osmesa_context]") {
    CHECK_THROWS_WITH(OsmesaContext({"libm.so.6"}), Contains("OSMesaCreateContextAttribs"));
}

TEST_CASE("The memory context has GL 3.3 and can be made again", "[render][osmesa_context]") {
    for (int round = 0; round < 2; ++round) {
        const OsmesaContext context;
        GLint major = 0, minor = 0;
        gl::GetIntegerv(GL_MAJOR_VERSION, &major);
        gl::GetIntegerv(GL_MINOR_VERSION, &minor);
        CHECK(major * 10 + minor >= 33);
        CHECK(gl::GetError() == GL_NO_ERROR);
    }
}

TEST_CASE("A driver without a function is refused by name", "[render][gl_functions]") {
    CHECK_THROWS_WITH(load_gl_functions([](const char*) { return static_cast<void*>(nullptr); }),
                      Contains("glActiveTexture"));
}

TEST_CASE("A shader that does not compile or link is an error with the driver's log", "[render][shader]") {
    const OsmesaContext context;
    const char* vertex = "void main() { gl_Position = vec4(0.0); }";
    CHECK_THROWS_WITH(Shader("broken", vertex, "out vec4 c; void main() { c = nonsense; }"),
                      Contains("shader broken") && Contains("nonsense"));
    CHECK_THROWS_WITH(Shader("apart",
                             "out vec2 shared; void main() { shared = vec2(0.0); gl_Position = vec4(0.0); }",
                             "in vec3 shared; out vec4 c; void main() { c = vec4(shared, 1.0); }"),
                      Contains("shader apart") && Contains("shared"));
    CHECK_NOTHROW(Shader("good", vertex, "out vec4 c; void main() { c = vec4(1.0); }"));
}
