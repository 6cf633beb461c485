#include "editor/paint_driver.hpp"

using namespace fascicle;
using namespace fascicle::editor;
using fascicle::test::blades;
using fascicle::test::PaintDriver;

namespace {

const Vec3 middle(40, 0, 20);
constexpr Modifiers ctrl{.ctrl = true}, shift{.shift = true};

bool front(const Vec3& p) {
    return p.y() == 0;
}

bool ring(const Vec3& p) { // open square line
    const double x = std::abs(p.x() - 40), z = std::abs(p.z() - 20);
    return front(p) && std::max(x, z) >= 5 && std::max(x, z) <= 10;
}

} // namespace

TEST_CASE("Smart fill takes the face up to its creases", "[editor][paint]") {
    PaintDriver d;
    d.key(key_4);
    d.move_to(d.place(middle));
    const std::vector<int> promised = d.tool().preview();
    d.press();
    d.release();
    CHECK(d.last_step() == "Smart fill insertion, gluteus");
    CHECK(d.painted().size() == 61 * 41); // all of the front
    CHECK(d.painted() == promised);
    CHECK(d.on_back(d.painted()) == 0);
    d.key(key_z, ctrl);
    d.settings().crease_deg = 95;
    d.paint_at(middle);
    CHECK(d.on_back(d.painted()) == 59 * 39);
    d.hold(key_left_ctrl, ctrl);
    d.paint_at(middle);
    d.let_go(key_left_ctrl);
    CHECK(d.painted().empty());
}

TEST_CASE("The bucket stops at a painted border, with Ctrl it takes an island away", "[editor][paint]") {
    PaintDriver d;
    d.set(ring);
    const std::size_t line = d.painted().size();
    d.key(key_5);
    d.paint_at(middle);
    CHECK(d.last_step() == "Bucket fill insertion, gluteus");
    CHECK(d.painted().size() == 21 * 21);
    d.key(key_z, ctrl);
    CHECK(d.painted().size() == line);
    d.key(key_o); // another label's border stops it as well
    d.paint_at(middle);
    CHECK(d.painted(AttachmentKind::origin).size() == 9 * 9);
    CHECK(d.painted().size() == line);
    d.key(key_i);
    d.hold(key_left_ctrl, ctrl);
    d.paint_at(Vec3(49, 0, 20));
    d.let_go(key_left_ctrl);
    CHECK(d.painted().empty());
    CHECK(d.painted(AttachmentKind::origin).size() == 9 * 9);
}

TEST_CASE("The lasso takes what is seen inside its line", "[editor][paint]") {
    PaintDriver d;
    d.key(key_6);
    const auto draw = [&] {
        d.move_to(d.place(Vec3(30.5, 0, 10.5)));
        d.press();
        for (const Vec3& p : {Vec3(50.5, 0, 10.5), Vec3(50.5, 0, 30.5), Vec3(30.5, 0, 30.5)})
            d.move_to(d.place(p));
        d.release();
    };
    const std::size_t before = d.steps();
    draw();
    CHECK(d.last_step() == "Lasso insertion, gluteus");
    CHECK(d.painted().size() == Approx(400).margin(3));
    CHECK(d.on_back(d.painted()) == 0);
    CHECK(d.steps() == before + 1);
    d.hold(key_left_ctrl, ctrl);
    draw();
    d.let_go(key_left_ctrl);
    CHECK(d.painted().empty());
    d.click("paint/through");
    draw();
    CHECK(d.on_back(d.painted()) > 300);
    d.move_to(d.place(middle)); // Esc gives the line up
    d.press();
    d.move_to(d.place(Vec3(60, 0, 20)));
    const std::size_t now = d.steps();
    d.key(key_escape);
    d.release();
    CHECK(d.steps() == now);
    CHECK(d.state().tool == Tool::paint);
}

TEST_CASE("A line from click to click encloses an area, or is a strip when it stays open",
          "[editor][paint]") {
    PaintDriver d;
    d.key(key_7);
    const std::size_t before = d.steps();
    const Vec3 corners[] = {Vec3(30, 0, 10), Vec3(50, 0, 10), Vec3(50, 0, 30), Vec3(30, 0, 30)};
    for (const Vec3& p : corners)
        d.paint_at(p);
    CHECK(d.tool().line_points() == 4);
    CHECK(d.steps() == before);
    d.paint_at(corners[0]);
    CHECK(d.tool().line_points() == 0);
    CHECK(d.steps() == before + 1);
    CHECK(d.last_step() == "Line of insertion, gluteus");
    CHECK(d.painted().size() == Approx(441).margin(45));
    d.key(key_z, ctrl);

    d.settings().radius_mm = 2.3; // the grid is of 1 mm: no row lies on the border
    for (const Vec3& p : {corners[0], corners[1], middle})
        d.paint_at(p);
    d.key(key_backspace);
    CHECK(d.tool().line_points() == 2);
    d.key(key_enter);
    CHECK(d.tool().line_points() == 0);
    CHECK(d.painted().size() == Approx(21 * 5 + 2 * 8).margin(12));
    d.paint_at(corners[2]);
    d.key(key_escape);
    CHECK(d.tool().line_points() == 0);
    CHECK(d.state().tool == Tool::paint);
    d.paint_at(corners[2]);
    d.paint_at(corners[3]);
    d.paint_at(corners[3]); // a second click ends it there
    CHECK(d.tool().line_points() == 0);
    CHECK(d.steps() == before + 2);
}

TEST_CASE("Shift with the brackets grows and shrinks by one ring", "[editor][paint]") {
    PaintDriver d;
    d.set([](const Vec3& p) { return front(p) && std::abs(p.x() - 40) <= 5 && std::abs(p.z() - 20) <= 5; });
    const std::vector<int> square = d.painted();
    d.key(key_right_bracket, shift);
    CHECK(d.last_step() == "Grow insertion, gluteus");
    CHECK(d.painted().size() > square.size() + 40);
    d.key(key_left_bracket, shift);
    CHECK(d.last_step() == "Shrink insertion, gluteus");
    CHECK(d.painted() == square);
    CHECK(d.settings().radius_mm == 8);
}

TEST_CASE("One click keeps the largest, fills holes, inverts, clears", "[editor][paint]") {
    PaintDriver d;
    d.set([](const Vec3& p) { return ring(p) || (front(p) && p.x() < 13); });
    CHECK(d.paint().measure().numbers().region.islands == 2);
    CHECK(d.paint().measure().numbers().region.holes == 1);
    d.click("paint/keep_largest");
    CHECK(d.last_step() == "Keep the largest island of insertion, gluteus");
    CHECK(d.paint().measure().numbers().region.islands == 1);
    d.click("paint/fill_holes");
    CHECK(d.last_step() == "Fill holes of insertion, gluteus");
    CHECK(d.painted().size() == 21 * 21);
    CHECK(d.paint().measure().numbers().region.area == Approx(21 * 21).epsilon(0.03));
    CHECK((d.paint().measure().numbers().region.centroid - middle).norm() < 0.01);
    CHECK(d.paint().measure().numbers().border == Approx(84).epsilon(0.06));
    d.click("paint/invert");
    const std::size_t all = std::size_t(d.document().scene().bones[0].mesh->vertex_count());
    CHECK(d.last_step() == "Invert insertion, gluteus");
    CHECK(d.painted().size() == all - 21 * 21);
    d.click("paint/invert");
    d.click("paint/clear");
    CHECK(d.last_step() == "Clear insertion, gluteus");
    CHECK(d.painted().empty());
    const std::size_t now = d.steps();
    d.click("paint/clear"); // nothing left
    d.click("paint/keep_largest");
    CHECK(d.steps() == now);
}

TEST_CASE("What is locked is kept by fills and one-click operations too", "[editor][paint]") {
    PaintDriver d;
    d.set([](const Vec3& p) { return front(p) && p.x() < 30; }, AttachmentKind::origin);
    const std::vector<int> origin = d.painted(AttachmentKind::origin);
    d.click("paint/lock/origin");
    d.key(key_4);
    d.paint_at(middle);
    CHECK(d.painted(AttachmentKind::origin) == origin);
    CHECK(d.painted().size() == 61 * 41 - origin.size());
    d.click("paint/invert");
    CHECK(d.painted(AttachmentKind::origin) == origin);
    d.click("paint/lock/insertion");
    const std::size_t now = d.steps();
    d.click("paint/clear");
    d.key(key_right_bracket, shift);
    CHECK(d.steps() == now);
}
