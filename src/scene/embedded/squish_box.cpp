#include "embedded.hpp"

#include "fascicle/geometry/primitives.hpp"

namespace fascicle::embedded {

/// The artificial test of Cervenka & Kohout 2020, section 5.1: a box of 21 x 21 quads a face between two plates, one of
/// which comes down by 0.9 units a frame until 10 % of the gap is left, goes back, and rests. Nothing is attached.
Scene make_squish_box(int) {
    Scene scene;
    const auto add_plate = [&](const char* name, double low, double high) {
        Bone bone;
        bone.name = name;
        bone.mesh =
            std::make_shared<TriMesh>(box_mesh(Vec3(-200, low, -200), Vec3(200, high, 200), {1, 1, 1}));
        scene.bones.push_back(bone);
    };
    add_plate("plate_top", 100, 200);
    add_plate("plate_bottom", -100, 0);

    Muscle box;
    box.name = "box";
    box.mesh = std::make_shared<TriMesh>(box_mesh(Vec3(-50, 10, -50), Vec3(50, 90, 50), {21, 21, 21}));
    box.attach_automatically = false;
    scene.muscles.push_back(box);
    scene.timeline = make_shift_timeline(Vec3(0, -90, 0), {100, 100, 100}, 2, 0);
    // A soft box between plates that grip, as the published response does (it stops a vertex where it touches). Stiffer
    // walls buckle at random under a squeeze to a tenth, and without grip or damping the box then turns as it unfolds.
    bring_defaults(scene.parameters, {{"solver.stiffness", 0.2},
                                      {"solver.coarse", 0},
                                      {"solver.damping", 25},
                                      {"solver.iterations", 40},
                                      {"contact.friction", 1}});
    return scene;
}

} // namespace fascicle::embedded
