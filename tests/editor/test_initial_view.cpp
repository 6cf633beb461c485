#include "editor/initial_view.hpp"
#include "fascicle/scene/embedded_scenes.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace fascicle;
using namespace fascicle::editor;

TEST_CASE("A scene opens on a muscle between plates of few triangles", "[editor][initial_view]") {
    // The plates are 400 wide, 100 apart along y, and have corners only: 150 of them stand beside the box of 100.
    view::Camera camera;
    look_at_muscles(camera, make_embedded_scene("squish-box"));
    const Vec3 eye = camera.backward();
    CHECK(std::abs(eye.y()) < 0.3); // looks along the plates, into the gap
    CHECK(eye.z() > 0.1);           // from a little above
}
