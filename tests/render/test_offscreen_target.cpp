#include "fascicle/base/error.hpp"
#include "render/drawing.hpp"
#include "render/gl_functions.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::render;
using namespace fascicle::test;
using Catch::Matchers::Contains;

TEST_CASE("Read-back has its rows from the top", "[render][offscreen_target]") {
    const OsmesaContext context;
    for (const int supersampling : {1, 2}) {
        const OffscreenTarget target(6, 4, supersampling);
        target.bind();
        gl::ClearColor(1, 0, 0, 1);
        gl::Clear(GL_COLOR_BUFFER_BIT);
        gl::Enable(GL_SCISSOR_TEST);
        gl::Scissor(0, 3 * supersampling, 6 * supersampling,
                    supersampling); // top row in GL's count from below
        gl::ClearColor(0, 0, 1, 1);
        gl::Clear(GL_COLOR_BUFFER_BIT);
        target.resolve();
        gl::Disable(GL_SCISSOR_TEST);
        const Image image = target.read_back();
        REQUIRE(image.width == 6);
        REQUIRE(image.height == 4);
        CHECK(pixel(image, 2, 0) == std::array{0, 0, 255, 255});
        CHECK(pixel(image, 2, 1) == std::array{255, 0, 0, 255});
        CHECK(pixel(image, 5, 3) == std::array{255, 0, 0, 255});
    }
}

TEST_CASE("Supersampling averages 2x2 samples", "[render][offscreen_target]") {
    const OsmesaContext context;
    const OffscreenTarget target(2, 2, 2);
    target.bind();
    gl::Disable(GL_SCISSOR_TEST);
    gl::ClearColor(0, 0, 0, 1);
    gl::Clear(GL_COLOR_BUFFER_BIT);
    gl::Enable(GL_SCISSOR_TEST);
    gl::Scissor(0, 0, 1, 1); // one sample of the lower left pixel
    gl::ClearColor(1, 1, 1, 1);
    gl::Clear(GL_COLOR_BUFFER_BIT);
    target.resolve();
    const Image image = target.read_back();
    CHECK(std::abs(pixel(image, 0, 1)[0] - 64) <= 1);
    CHECK(pixel(image, 1, 1)[0] == 0);
    CHECK(pixel(image, 0, 0)[0] == 0);
}

TEST_CASE("Impossible sizes are errors and leave the context usable", "[render][offscreen_target]") {
    const OsmesaContext context;
    CHECK_THROWS_WITH(OffscreenTarget(16384, 16384, 2), Contains("16384x16384") && Contains("at most"));
    CHECK_THROWS_WITH(OffscreenTarget(100000, 10), Contains("100000x10"));
    CHECK_THROWS_WITH(OffscreenTarget(0, 10), Contains("0x10"));
    CHECK_NOTHROW(OffscreenTarget(16, 16, 2));
    CHECK(gl::GetError() == GL_NO_ERROR);
}

TEST_CASE("An incomplete framebuffer is reported", "[render][offscreen_target]") {
    const OsmesaContext context;
    unsigned framebuffer = 0;
    gl::GenFramebuffers(1, &framebuffer);
    gl::BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    CHECK_THROWS_WITH(require_complete_framebuffer("test picture"),
                      Contains("test picture") && Contains("no attachment"));
    gl::BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl::DeleteFramebuffers(1, &framebuffer);
}
