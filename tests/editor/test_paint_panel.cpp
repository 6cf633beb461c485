#include "editor/paint_driver.hpp"
#include "view/build_draw_list.hpp"

using namespace fascicle;
using namespace fascicle::editor;
using fascicle::test::blades;
using fascicle::test::PaintDriver;

namespace {

const Vec3 middle(40, 0, 20);
constexpr Modifiers ctrl{.ctrl = true};

} // namespace

TEST_CASE("The paint panel chooses tool, label, muscle and bone", "[editor][paint]") {
    PaintDriver d;
    for (const PaintKindRow& row : paint_kinds()) {
        d.click(std::string("paint/tool/") + row.id);
        CHECK(d.settings().kind == row.kind);
    }
    d.click("paint/tool/brush");
    d.click("paint/label/origin");
    CHECK(d.settings().label == AttachmentKind::origin);
    d.click("paint/muscle");
    d.click("paint/muscle/iliacus");
    d.paint_at(middle);
    CHECK(d.last_step() == "Paint origin, iliacus");
    d.click("paint/bone");
    d.click("paint/bone/blade_r");
    d.wait();
    CHECK(d.state().selection.name == "blade_r");
    d.paint_at(Vec3(-40, 0, 20));
    CHECK_FALSE(d.painted(AttachmentKind::origin, 1, 1).empty());
    const Rect slider = d.rect("paint/radius");
    d.drag({slider.min.x + slider.width() * 0.2f, d.middle("paint/radius").y},
           {slider.min.x + slider.width() * 0.9f, d.middle("paint/radius").y});
    CHECK(d.settings().radius_mm > 40);
    CHECK_FALSE(d.has("paint/enter"));
    d.click("paint/done");
    CHECK(d.state().tool == Tool::look);
}

TEST_CASE("The numbers of the area and the vertices it fixes follow every stroke", "[editor][paint]") {
    PaintDriver d;
    d.wait();
    CHECK(d.paint().measure().numbers().region.vertices == 0);
    d.settings().radius_mm = 5;
    d.move_to(d.place(middle));
    d.press();
    d.frame();
    CHECK(d.paint().measure().numbers().region.area ==
          Approx(25 * 3.14159).epsilon(0.1)); // before the release
    d.release();
    d.wait();
    const auto fixed = d.paint().fixed().vertices();
    REQUIRE(fixed != nullptr);
    CHECK(fixed->size() > 5);
    const TriMesh& muscle = *d.document().scene().muscles[0].mesh;
    for (const int v : *fixed)
        CHECK(-muscle.positions[std::size_t(v)].y() <= 2.5 + 1e-9);
    CHECK(d.has("paint/fixed_count"));
    d.click("paint/show_fixed");
    CHECK_FALSE(d.has("paint/fixed_count"));
    d.key(key_z, ctrl);
    d.frame(2);
    CHECK(d.paint().measure().numbers().region.vertices == 0);
}

TEST_CASE("Heads are added, painted apart and removed with their areas", "[editor][paint]") {
    PaintDriver d;
    d.paint_at(Vec3(25, 0, 20));
    const std::vector<int> first = d.painted();
    d.click("paint/new_head");
    d.type("long");
    d.key(key_enter);
    CHECK(d.settings().head == "long");
    d.paint_at(Vec3(55, 0, 20));
    CHECK(d.last_step() == "Paint insertion of long, gluteus");
    CHECK(d.painted() == first);
    CHECK_FALSE(d.painted(AttachmentKind::insertion, 0, 0, "long").empty());
    d.click("paint/head");
    d.click("paint/head/");
    CHECK(d.settings().head.empty());
    d.click("paint/area/1");
    CHECK(d.settings().head == "long");
    d.click("paint/head_remove");
    CHECK(d.last_step() == "Remove head long, gluteus");
    CHECK(d.settings().head.empty());
    CHECK(d.document().scene().muscles[0].areas.size() == 1);
    d.click("paint/area/0/remove");
    CHECK(d.last_step() == "Remove insertion, gluteus");
    CHECK(d.document().scene().muscles[0].areas.empty());
}

TEST_CASE("Outlines become areas, and attachments given by vertex give way to them", "[editor][paint]") {
    Scene scene = blades();
    AttachmentOutline outline;
    outline.kind = AttachmentKind::insertion;
    outline.bone = "blade_l";
    for (const auto& [x, z] :
         {std::pair{30, 10}, {40, 10}, {50, 10}, {50, 20}, {50, 30}, {40, 30}, {30, 30}, {30, 20}})
        outline.points.emplace_back(x, 0, z);
    scene.muscles[0].outlines = {outline};
    scene.muscles[0].attachments = {{AttachmentKind::origin, 1, {0, 1, 2}}};
    PaintDriver d(std::move(scene));
    d.click("paint/from_outlines");
    CHECK(d.last_step() == "Areas from outlines, gluteus");
    CHECK(d.painted().size() == Approx(441).margin(45));
    d.click("paint/drop_fixed");
    CHECK(d.last_step() == "Use areas, gluteus");
    CHECK(d.document().scene().muscles[0].attachments.empty());
    CHECK_FALSE(d.has("paint/drop_fixed"));
}

TEST_CASE("Selecting in the list changes what is painted, removing it ends painting", "[editor][paint]") {
    PaintDriver d;
    d.click("tree/blade_r");
    d.wait();
    CHECK(d.paint().bone(d.context()) == 1);
    d.click("tree/iliacus");
    CHECK(d.paint().muscle(d.context()) == 1);
    CHECK(d.paint().bone(d.context()) == 1);
    d.click("tree/blade_r");
    d.key(key_h); // what is hidden is not painted
    const std::size_t before = d.steps();
    d.paint_at(Vec3(-40, 0, 20));
    CHECK(d.steps() == before);
    d.key(key_h, {.alt = true});
    d.key(key_delete);
    d.frame(2);
    CHECK(d.state().tool == Tool::look);
    CHECK(d.document().scene().bone_index("blade_r") < 0);
}

TEST_CASE("Another document ends painting", "[editor][paint]") {
    PaintDriver d;
    d.move_to(d.place(middle));
    d.press();
    d.editor().replace_document(Document(test::small_scene()));
    d.release();
    d.frame(3);
    CHECK(d.state().tool == Tool::look);
    CHECK(d.state().side_panel == "parameters");
    d.select("fixed");
    d.key(key_tab);
    d.wait();
    CHECK(d.state().tool == Tool::paint);
}

TEST_CASE("The view shows areas outside of paint mode too, and fades the rest within", "[editor][paint]") {
    PaintDriver d;
    d.set([](const Vec3& p) { return p.y() == 0 && p.x() < 40; });
    const auto list = [&] {
        view::DrawCache cache;
        const view::ViewSubject subject = view_subject(d.context());
        return view::build_draw_list(subject, view_options(d.context(), *subject.scene),
                                     d.state().camera.pose(1.5), cache);
    };
    const auto item = [](const render::DrawList& drawn, std::uint64_t id) {
        for (const render::SurfaceItem& one : drawn.surfaces)
            if (one.id == id)
                return one;
        FAIL("not drawn");
        return render::SurfaceItem{};
    };
    render::DrawList drawn = list();
    CHECK(item(drawn, view::bone_item_id(0)).live_colours != nullptr);
    CHECK(item(drawn, view::bone_item_id(0)).colour[3] == 1);
    CHECK(item(drawn, view::bone_item_id(1)).colour[3] < 0.5f);
    CHECK(item(drawn, view::muscle_item_id(0)).colour[3] < 0.5f);
    d.key(key_tab);
    drawn = list();
    CHECK(item(drawn, view::bone_item_id(0)).live_colours != nullptr);
    CHECK(item(drawn, view::bone_item_id(1)).colour[3] == 1);
    d.key(key_a);
    CHECK(item(list(), view::bone_item_id(0)).live_colours == nullptr);
    d.key(key_tab);
    CHECK(item(list(), view::bone_item_id(0)).live_colours != nullptr); // painting shows what is painted
}

TEST_CASE("The paint panel draws at every size and scale, idle and painting", "[editor][paint]") {
    for (const auto& [width, height, scale] :
         {std::tuple{320.0f, 240.0f, 1.0f}, std::tuple{2560.0f, 1600.0f, 2.0f}}) {
        test::Driver d(blades(), width, height, scale);
        d.state().side_panel = "paint";
        d.frame(3);
        d.state().selection = {Selection::Kind::bone, "blade_l"};
        d.frame(2);
        d.key(key_tab);
        d.frame(3);
        CHECK(d.state().tool == Tool::paint);
        d.state().dark = false;
        d.frame(3);
    }
}

TEST_CASE("The paint panel of an empty scene says what is missing", "[editor][paint]") {
    test::Driver d(Scene{});
    d.state().side_panel = "paint";
    d.frame(3);
    d.click("paint/enter");
    CHECK(d.state().tool == Tool::look);
    CHECK(d.command_state(Command::paint_mode).reason == "the scene has no muscle to paint for");
}
