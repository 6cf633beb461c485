#include "fascicle/scene/embedded_scenes.hpp"
#include "scene/embedded/hip_shapes.hpp"

#include "../geometry/surface_checks.hpp"
#include "fascicle/geometry/volume.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;

namespace {

const Scene& hip() { // made once: all tests here look at the same one
    static const Scene scene = make_embedded_scene("hip", 2);
    return scene;
}

const TriMesh& bone(const char* name) {
    return *hip().bones.at(static_cast<std::size_t>(hip().bone_index(name))).mesh;
}

double distance_to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    // Foot in the plane if it lies in the triangle, else the nearest of the three sides.
    const Vec3 n = (b - a).cross(c - a).normalized();
    const Vec3 q = p - (p - a).dot(n) * n;
    const bool inside = (b - a).cross(q - a).dot(n) >= 0 && (c - b).cross(q - b).dot(n) >= 0 &&
                        (a - c).cross(q - c).dot(n) >= 0;
    if (inside)
        return (p - q).norm();
    const auto side = [&](const Vec3& s, const Vec3& e) {
        const double t = std::clamp((p - s).dot(e - s) / (e - s).squaredNorm(), 0.0, 1.0);
        return (p - s - t * (e - s)).norm();
    };
    return std::min({side(a, b), side(b, c), side(c, a)});
}

double distance_to_mesh(const Vec3& p, const TriMesh& mesh) {
    double best = 1e300;
    const auto at = [&](int v) -> const Vec3& { return mesh.positions[static_cast<std::size_t>(v)]; };
    for (const Tri& t : mesh.triangles) {
        if ((at(t[0]) - p).norm() > best + 12.0) // no edge is that long
            continue;
        best = std::min(best, distance_to_triangle(p, at(t[0]), at(t[1]), at(t[2])));
    }
    return best;
}

} // namespace

// One test case, because CTest runs each in a process of its own and making the scene takes most of the time.
TEST_CASE("the hip scene is anatomy that can move", "[scene][embedded][hip][slow]") {
    SECTION("the hip scene has its bones and muscles with good triangles") {
        struct Row {
            const char* name;
            int triangles, euler;
        };
        // The obturator foramen makes the hip bone a ring.
        for (const Row& row :
             {Row{"right_iliac", 26000, 0}, Row{"sacrum", 8000, 2}, Row{"femur", 20000, 2}}) {
            INFO(row.name);
            const auto r = test::report(bone(row.name));
            CHECK(bone(row.name).triangle_count() == row.triangles);
            CHECK(r.euler == row.euler);
            CHECK(r.mean_quality > 0.9);
            CHECK(r.min_angle_deg > 3.0);
            CHECK(r.longest_edge < 10.0);
        }
        REQUIRE(hip().muscles.size() == 2);
        CHECK(hip().muscles[0].name == "gluteus_maximus");
        CHECK(hip().muscles[1].name == "iliacus");
        CHECK(hip().muscles[0].mesh->triangle_count() == 15000);
        CHECK(hip().muscles[1].mesh->triangle_count() == 10000);
        for (const Muscle& muscle : hip().muscles) {
            INFO(muscle.name);
            const auto r = test::report(*muscle.mesh);
            CHECK(r.euler == 2);
            CHECK(r.mean_quality > 0.93);
            CHECK(r.min_angle_deg > 10.0);
            CHECK(r.longest_edge / r.shortest_edge < 12.0);
        }
    }

    SECTION("the bones of the hip have human size, and the head of the femur is a ball about the hinge") {
        const auto extent = [](const TriMesh& mesh) {
            Vec3 low = mesh.positions[0], high = low;
            for (const Vec3& p : mesh.positions) {
                low = low.cwiseMin(p);
                high = high.cwiseMax(p);
            }
            return Vec3(high - low);
        };
        CHECK(extent(bone("femur")).z() == Approx(428).margin(15));
        CHECK(extent(bone("right_iliac")).z() == Approx(220).margin(20));
        CHECK(extent(bone("sacrum")).x() == Approx(110).margin(12));
        REQUIRE(hip().timeline.hinge);
        CHECK(hip().timeline.hinge->centre == Vec3::Zero());
        CHECK(hip().timeline.angle_rad(100) == Approx(-1.0));
        int on_head = 0;
        double worst = 0.0;
        for (const Vec3& p : bone("femur").positions)
            if (p.z() > 5.0 && p.x() > -10.0) {
                ++on_head;
                worst = std::max(worst, std::abs(p.norm() - embedded::head_radius));
            }
        CHECK(on_head > 100);
        CHECK(worst < 0.05);
    }

    SECTION("femur and pelvis keep at least 1 mm apart through the whole flexion") {
        const ImplicitShape sacrum = embedded::sacrum_shape();
        const ImplicitShape iliac = embedded::iliac_shape(sacrum);
        double least = 1e300;
        for (int frame = 0; frame <= 100; frame += 10) {
            const Pose pose = hip().timeline.bone_pose(hip().bone_index("femur"), frame);
            for (const Vec3& p : bone("femur").positions)
                if (p.norm() < 130.0) {
                    const Vec3 q = pose.apply(p);
                    least = std::min({least, iliac(q), sacrum(q)});
                }
        }
        CHECK(least > 1.0);
        CHECK(least < 3.0); // it is a joint, after all
        for (const char* fixed : {"right_iliac", "sacrum"})
            CHECK(hip().timeline.bone_pose(hip().bone_index(fixed), 100).is_identity());
        double joint = 1e300; // sacro-iliac: close, but apart
        for (std::size_t v = 0; v < bone("right_iliac").positions.size(); v += 5)
            joint = std::min(joint, sacrum(bone("right_iliac").positions[v]));
        CHECK(joint > 0.8);
        CHECK(joint < 3.0);
    }

    SECTION("muscles of the hip touch bones without entering them, and not each other") {
        for (const Muscle& muscle : hip().muscles) {
            INFO(muscle.name);
            const Points& points = muscle.mesh->positions;
            int inside = 0;
            double least = 1e300;
            for (std::size_t v = 0; v < points.size(); v += 23)
                for (const Bone& b : hip().bones) {
                    const double d = distance_to_mesh(points[v], *b.mesh);
                    least = std::min(least, d);
                    // Only near a bone can a vertex be in it: the thickest half of a bone is the head's radius.
                    if (d < 25.0 && winding_number(b.mesh->positions, b.mesh->triangles, points[v]) > 0.5)
                        ++inside;
                }
            CHECK(inside == 0);
            CHECK(least > 0.15);
            CHECK(least < 1.0);
            for (const Attachment& a : muscle.attachments)
                for (std::size_t i = 0; i < a.vertices.size(); i += 29) {
                    const TriMesh& mesh = *hip().bones[static_cast<std::size_t>(a.bone)].mesh;
                    CHECK(distance_to_mesh(points[static_cast<std::size_t>(a.vertices[i])], mesh) < 1.25);
                }
        }
        double apart = 1e300;
        for (std::size_t v = 0; v < hip().muscles[1].mesh->positions.size(); v += 23)
            apart = std::min(apart,
                             distance_to_mesh(hip().muscles[1].mesh->positions[v], *hip().muscles[0].mesh));
        CHECK(apart > 3.0);
    }

    SECTION("gluteus maximus is fixed to ilium, sacrum and femur, iliacus to ilium and femur") {
        const auto check = [](const Muscle& muscle, std::size_t at, const char* bone_name,
                              AttachmentKind kind, std::size_t at_least) {
            const Attachment& a = muscle.attachments.at(at);
            CHECK(a.bone == hip().bone_index(bone_name));
            CHECK(a.kind == kind);
            CHECK(a.vertices.size() >= at_least);
        };
        check(hip().muscles[0], 0, "right_iliac", AttachmentKind::origin, 100);
        check(hip().muscles[0], 1, "sacrum", AttachmentKind::origin, 60);
        check(hip().muscles[0], 2, "femur", AttachmentKind::insertion, 60);
        check(hip().muscles[1], 0, "right_iliac", AttachmentKind::origin, 800);
        check(hip().muscles[1], 1, "femur", AttachmentKind::insertion, 30);
        CHECK_FALSE(hip().muscles[0].attach_automatically);
    }

    SECTION("the hip scene is the same for every thread count") {
        const Scene single = make_embedded_scene("hip", 1);
        for (std::size_t i = 0; i < single.bones.size(); ++i)
            CHECK(single.bones[i].mesh->positions == hip().bones[i].mesh->positions);
        for (std::size_t i = 0; i < single.muscles.size(); ++i) {
            CHECK(single.muscles[i].mesh->positions == hip().muscles[i].mesh->positions);
            CHECK(single.muscles[i].mesh->triangles == hip().muscles[i].mesh->triangles);
        }
    }
}
