#include "view/camera.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::view;

namespace {

constexpr double pi = 3.14159265358979323846;
const ViewSize size{320, 200};

Eigen::Matrix4d matrix(const render::Mat4f& m) {
    Eigen::Matrix4d result;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            result(row, column) = static_cast<double>(m[static_cast<std::size_t>(4 * column + row)]);
    return result;
}

// Clip coordinates over w: the oracle for project() and ray().
Vec3 normalised(const Camera& camera, const Vec3& point) {
    const render::CameraPose pose = camera.pose(size.aspect());
    const Eigen::Vector4d clip = matrix(pose.projection) * (matrix(pose.view) * point.homogeneous());
    return clip.head<3>() / clip.w();
}

BoundingBox box(const Vec3& min, const Vec3& max) {
    BoundingBox result;
    result.add(min);
    result.add(max);
    return result;
}

Camera skew_camera(bool orthographic) {
    Camera camera;
    camera.set_orthographic(orthographic);
    camera.orbit_by(0.6, 0.3);
    camera.set_scene_bounds(box(Vec3(-2, -1, -3), Vec3(2, 3, 1)));
    camera.frame(box(Vec3(-2, -1, -3), Vec3(2, 3, 1)), size.aspect());
    return camera;
}

} // namespace

TEST_CASE("The anatomical frames are right-handed and name the axes", "[view][camera]") {
    for (const WorldAxes axes : {WorldAxes::lps, WorldAxes::y_up}) {
        const AnatomicalFrame body = anatomical_frame(axes);
        CHECK(body.superior.cross(body.anterior) == body.left);
    }
    CHECK(anatomical_frame(WorldAxes::lps).left == Vec3::UnitX());
    CHECK(anatomical_frame(WorldAxes::lps).anterior == -Vec3::UnitY());
    CHECK(anatomical_frame(WorldAxes::y_up).left == -Vec3::UnitZ()); // OpenSim's z points to the right
}

TEST_CASE("Standard views look from their side with the right way up", "[view][camera]") {
    for (const WorldAxes axes : {WorldAxes::lps, WorldAxes::y_up}) {
        const AnatomicalFrame body = anatomical_frame(axes);
        const auto check = [&](StandardView view, const Vec3& from, const Vec3& up, const Vec3& right) {
            Camera camera(axes);
            camera.orbit_by(1.0, 0.5); // whatever was before does not matter
            camera.look_from(view);
            CHECK((camera.backward() - from).norm() < 1e-12);
            CHECK((camera.up() - up).norm() < 1e-12);
            CHECK((camera.right() - right).norm() < 1e-12);
        };
        check(StandardView::anterior, body.anterior, body.superior, body.left);
        check(StandardView::posterior, -body.anterior, body.superior, -body.left);
        check(StandardView::left, body.left, body.superior, -body.anterior);
        check(StandardView::right, -body.left, body.superior, body.anterior);
        check(StandardView::superior, body.superior, body.anterior, -body.left);
        check(StandardView::inferior, -body.superior, body.anterior, body.left);
    }
}

TEST_CASE("Framing fills the view at any scale", "[view][camera]") {
    for (const double scale : {2e-3, 2.0, 2000.0, 2e6})
        for (const bool orthographic : {false, true})
            for (const double aspect : {1.6, 0.5}) {
                const ViewSize view{200 * aspect, 200};
                const BoundingBox bounds = box(scale * Vec3(3.0, -1.0, 0.5), scale * Vec3(3.6, -0.5, 1.5));
                Camera camera;
                camera.orbit_by(0.7, 0.4);
                camera.set_orthographic(orthographic);
                camera.set_scene_bounds(bounds);
                camera.frame(bounds, aspect);
                double reach = 0; // 1: a corner lies on the border of the picture
                double low[2] = {1, 1}, high[2] = {-1, -1};
                for (int corner = 0; corner < 8; ++corner) {
                    const Vec3 p(corner & 1 ? bounds.max.x() : bounds.min.x(),
                                 corner & 2 ? bounds.max.y() : bounds.min.y(),
                                 corner & 4 ? bounds.max.z() : bounds.min.z());
                    const auto at = camera.project(p, view);
                    REQUIRE(at);
                    const double place[2] = {2 * at->x() / view.width - 1, 2 * at->y() / view.height - 1};
                    for (int k = 0; k < 2; ++k) {
                        reach = std::max(reach, std::abs(place[k]));
                        low[k] = std::min(low[k], place[k]);
                        high[k] = std::max(high[k], place[k]);
                    }
                    // and between the near and far plane
                    const render::CameraPose pose = camera.pose(aspect);
                    const Eigen::Vector4d clip =
                        matrix(pose.projection) * (matrix(pose.view) * p.homogeneous());
                    CHECK(std::abs(clip.z() / clip.w()) < 1.0);
                }
                CHECK(reach <= 0.97);
                // One direction is filled from border to border
                CHECK(std::max(high[0] - low[0], high[1] - low[1]) > 1.9);
            }
}

TEST_CASE("Framing something degenerate leaves a usable camera", "[view][camera]") {
    Camera camera;
    const double before = camera.distance();
    camera.frame(BoundingBox{}, 1.0);
    camera.frame(Points{}, 1.0);
    CHECK(camera.distance() == before);
    camera.frame(box(Vec3(5, 5, 5), Vec3(5, 5, 5)), 1.0);
    CHECK(camera.pivot() == Vec3(5, 5, 5));
    CHECK(camera.distance() > 0.5);
    camera.frame(box(Vec3(0, 0, 0), Vec3(0, 0, 10)), 1.0); // a line
    CHECK(std::isfinite(camera.distance()));
    CHECK(camera.distance() > 5);
}

TEST_CASE("project, ray and the matrices agree", "[view][camera]") {
    for (const bool orthographic : {false, true}) {
        const Camera camera = skew_camera(orthographic);
        for (const Vec3& point : {Vec3(0, 0, 0), Vec3(1.5, 2.5, 0.5), Vec3(-1, -0.5, -2)}) {
            const Vec3 seen = normalised(camera, point);
            const auto at = camera.project(point, size);
            REQUIRE(at);
            CHECK(at->x() == Approx((seen.x() + 1) / 2 * size.width).margin(1e-3));
            CHECK(at->y() == Approx((1 - seen.y()) / 2 * size.height).margin(1e-3));
            const Ray ray = camera.ray(at->x(), at->y(), size);
            CHECK(ray.direction.norm() == Approx(1.0));
            CHECK((point - ray.origin).cross(ray.direction).norm() < 1e-9);
            CHECK((point - ray.origin).dot(ray.direction) > 0);
            CHECK(std::abs(seen.z()) < 1);
        }
    }
    const Camera camera = skew_camera(false);
    CHECK_FALSE(camera.project(camera.eye() + camera.backward(), size));
    // The view matrix is rigid and sends the eye to the origin
    const Eigen::Matrix4d view = matrix(camera.pose(1.0).view);
    CHECK((view * camera.eye().homogeneous()).head<3>().norm() < 1e-5);
    CHECK(view.topLeftCorner<3, 3>().determinant() == Approx(1.0));
}

TEST_CASE("Zooming keeps the place under the pointer", "[view][camera]") {
    for (const bool orthographic : {false, true}) {
        Camera camera = skew_camera(orthographic);
        const double before = camera.distance();
        // A point of the pivot's plane
        const Vec3 point = camera.pivot() + 0.8 * camera.right() - 0.5 * camera.up();
        const Vec2 at = *camera.project(point, size);
        camera.zoom(0.5, at.x(), at.y(), size);
        CHECK(camera.distance() == Approx(0.5 * before));
        CHECK((*camera.project(point, size) - at).norm() < 1e-9);
        camera.zoom(2.0, at.x(), at.y(), size);
        CHECK((camera.pivot() - skew_camera(orthographic).pivot()).norm() < 1e-9);
        for (int i = 0; i < 1000; ++i)
            camera.zoom(0.5, 10, 10, size);
        CHECK(camera.distance() > 0);
        CHECK(camera.pivot().allFinite());
    }
}

TEST_CASE("Panning moves the scene with the pointer", "[view][camera]") {
    for (const bool orthographic : {false, true}) {
        Camera camera = skew_camera(orthographic);
        const Vec3 point = camera.pivot();
        const Vec2 before = *camera.project(point, size);
        camera.pan(30, -12, size);
        const Vec2 after = *camera.project(point, size);
        CHECK((after - before - Vec2(30, -12)).norm() < 1e-9);
    }
}

TEST_CASE("Orbiting turns the near side with the pointer and stops at the poles", "[view][camera]") {
    Camera camera = skew_camera(false);
    const Vec3 near_side = camera.pivot() + 0.5 * camera.backward();
    const Vec2 before = *camera.project(near_side, size);
    const double distance = camera.distance();
    camera.orbit(5, 3, size);
    const Vec2 after = *camera.project(near_side, size);
    CHECK(after.x() > before.x());
    CHECK(after.y() > before.y());
    CHECK((camera.eye() - camera.pivot()).norm() == Approx(distance));
    camera.orbit(0, 1e5, size);
    CHECK(camera.pitch_rad() == Approx(pi / 2));
    CHECK(camera.right().norm() == Approx(1.0)); // no collapse at the pole
    camera.orbit(0, -1e6, size);
    CHECK(camera.pitch_rad() == Approx(-pi / 2));
}

TEST_CASE("Switching to orthographic keeps the pivot's plane, a new pivot keeps the eye", "[view][camera]") {
    Camera camera = skew_camera(false);
    const Vec3 in_plane = camera.pivot() + 0.7 * camera.right() + 0.4 * camera.up();
    const Vec2 before = *camera.project(in_plane, size);
    camera.set_orthographic(true);
    CHECK((*camera.project(in_plane, size) - before).norm() < 1e-9);

    camera.set_orthographic(false);
    const Vec3 eye = camera.eye();
    camera.set_pivot(Vec3(1.0, 0.5, -0.5));
    CHECK((camera.eye() - eye).norm() < 1e-9);
    CHECK((*camera.project(Vec3(1.0, 0.5, -0.5), size) - Vec2(160, 100)).norm() < 1e-6);
}

TEST_CASE("The near plane stays in front of the eye inside a large scene", "[view][camera]") {
    Camera camera = skew_camera(false);
    camera.set_scene_bounds(box(Vec3::Constant(-1000), Vec3::Constant(1000)));
    const Eigen::Matrix4d projection = matrix(camera.pose(1.0).projection);
    // near = c / (a - 1), far = c / (a + 1) for the rows of a perspective matrix
    const double a = projection(2, 2), c = projection(2, 3);
    CHECK(c / (a - 1) > 0);
    CHECK(c / (a + 1) > 1500);
    camera.set_fov_deg(1000);
    CHECK(camera.fov_deg() == Approx(120));
}
