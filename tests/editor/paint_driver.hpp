#pragma once
// Painting like a person: two thin blades seen from the front, a muscle before the left one.

#include "editor/driver.hpp"
#include "editor/features.hpp"
#include "editor/scene_view.hpp"
#include "fascicle/document/actions/area_actions.hpp"
#include "fascicle/geometry/primitives.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

namespace fascicle::test {

/// blade_l: x 10 to 70, y 0 to 2 (front at y = 0), z 0 to 40, mm; blade_r mirrored; block: far above, at rest. Muscle: a sphere
/// whose back is 1 mm in front of blade_l's middle. blade_l turns when `moving`.
inline Scene blades(bool moving = false) {
    Scene scene;
    scene.name = "blades";
    const auto add = [&](const char* name, const Vec3& low, const Vec3& high, std::array<int, 3> cells) {
        scene.bones.push_back({name, std::make_shared<const TriMesh>(box_mesh(low, high, cells)), {}});
    };
    add("blade_l", Vec3(10, 0, 0), Vec3(70, 2, 40), {60, 2, 40});
    add("blade_r", Vec3(-70, 0, 0), Vec3(-10, 2, 40), {60, 2, 40});
    add("block", Vec3(-10, 0, 60), Vec3(10, 10, 70), {10, 5, 5});
    for (const char* name : {"gluteus", "iliacus"}) {
        Muscle muscle;
        muscle.name = name;
        muscle.mesh = std::make_shared<const TriMesh>(sphere(8, 3, Vec3(40, -9, 20)));
        muscle.attach_automatically = false;
        scene.muscles.push_back(std::move(muscle));
    }
    scene.timeline = make_hinge_timeline({Vec3(40, 1, 20), Vec3::UnitZ()}, moving ? 0.6 : 0.0, {30, 30, 0},
                                         static_cast<int>(scene.bones.size()), {0});
    return scene;
}

class PaintDriver : public Driver {
public:
    explicit PaintDriver(Scene scene = blades(), const char* bone = "blade_l", bool enter = true)
        : Driver(std::move(scene), 1280, 1900) { // tall: the whole panel is in sight
        frame(3);
        key(editor::key_pad_0 + 1); // from the front
        state().playback.playing = false;
        select(bone);
        if (enter) {
            key(editor::key_tab);
            wait();
        }
    }
    void select(const char* bone) {
        state().selection = {editor::Selection::Kind::bone, bone};
        frame();
    }
    /// Until nothing is computed beside.
    void wait() {
        for (int i = 0; i < 400; ++i) {
            frame();
            if (!paint().preparing() && !paint().fixed().busy())
                return;
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        FAIL("the surface was not ready in time");
    }

    editor::EditorContext context() { return editor().context(); }
    editor::PaintMode& paint() { return editor().features().paint; }
    editor::PaintTool& tool() { return editor().features().paint_tool; }
    editor::PaintSettings& settings() { return paint().settings; }

    /// Where a point of the scene is on the screen.
    ImVec2 place(const Vec3& point) {
        const editor::Rect area = rect("viewport");
        const auto at = state().camera.project(point, {double(area.width()), double(area.height())});
        REQUIRE(at);
        return {area.min.x + float(at->x()), area.min.y + float(at->y())};
    }
    void hold(int code, editor::Modifiers with) { // a key goes down and stays
        editor().input().key(code, true, with);
        frame();
    }
    void let_go(int code) {
        editor().input().key(code, false, {});
        frame();
    }
    void paint_at(const Vec3& point) {
        move_to(place(point));
        press();
        release();
        frame(20);
    }
    void paint_along(const Vec3& from, const Vec3& to, int button = 0) {
        drag(place(from), place(to), button);
        frame(20);
    }

    std::size_t steps() { return document().history().steps().size(); }
    std::string last_step() { return document().history().undo_name(); }
    /// Vertices of an area; none when it is not there.
    std::vector<int> painted(AttachmentKind kind = AttachmentKind::insertion, int bone = 0, int muscle = 0,
                             const std::string& head = "") {
        const AttachmentArea* area = actions::find_area(document().scene(), {muscle, kind, bone, head});
        return area == nullptr ? std::vector<int>{} : area->vertices.vertices();
    }
    const Vec3& vertex(int v, int bone = 0) {
        return document().scene().bones[std::size_t(bone)].mesh->positions[std::size_t(v)];
    }
    /// How many of the painted vertices lie on the blade's back, inside its rim.
    int on_back(const std::vector<int>& vertices) {
        int count = 0;
        for (const int v : vertices)
            count += vertex(v).y() > 1.9 && std::abs(vertex(v).x() - 40) < 29.5 &&
                     std::abs(vertex(v).z() - 20) < 19.5;
        return count;
    }
    /// Makes an area without painting.
    template <class Inside>
    void set(const Inside& inside, AttachmentKind kind = AttachmentKind::insertion, int bone = 0) {
        const TriMesh& mesh = *document().scene().bones[std::size_t(bone)].mesh;
        SurfaceRegion region(mesh.vertex_count());
        for (int v = 0; v < mesh.vertex_count(); ++v)
            if (inside(mesh.positions[std::size_t(v)]))
                region.insert(v);
        actions::set_area(document(), {0, kind, bone, ""}, region);
        frame(2);
    }
};

} // namespace fascicle::test
