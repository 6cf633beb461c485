#include "fascicle/document/document.hpp"
#include "fascicle/document/history.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;

namespace {

std::shared_ptr<const int> number(int value) {
    return std::make_shared<const int>(value);
}

std::shared_ptr<const TriMesh> mesh_of(std::size_t points) {
    auto mesh = std::make_shared<TriMesh>();
    mesh->positions.assign(points, Vec3::Zero());
    return mesh;
}

} // namespace

TEST_CASE("History walks back and forth over what was committed", "[document][history]") {
    History<int> history(number(0), "Open");
    CHECK_FALSE(history.can_undo());
    CHECK_FALSE(history.can_redo());
    CHECK_FALSE(history.undo());
    history.commit(number(1), "one");
    history.commit(number(2), "two");
    CHECK(history.undo_name() == "two");
    REQUIRE(history.undo());
    CHECK(*history.head() == 1);
    CHECK(history.redo_name() == "two");
    REQUIRE(history.redo());
    CHECK(*history.head() == 2);
    CHECK_FALSE(history.redo());
    REQUIRE(history.jump(0));
    CHECK(*history.head() == 0);
    CHECK_FALSE(history.jump(0));
    CHECK_FALSE(history.jump(3));
}

TEST_CASE("A commit after undo drops what could be redone", "[document][history]") {
    History<int> history(number(0), "Open");
    history.commit(number(1), "one");
    history.commit(number(2), "two");
    history.undo();
    history.commit(number(3), "three");
    CHECK_FALSE(history.can_redo());
    CHECK(history.steps().size() == 3);
    history.undo();
    CHECK(*history.head() == 1);
}

TEST_CASE("History keeps no more steps than its count allows", "[document][history]") {
    History<int> history(number(0), "Open", {}, {.steps = 4, .bytes = 1000});
    for (int i = 1; i <= 10; ++i)
        history.commit(number(i), std::to_string(i));
    CHECK(history.steps().size() == 4);
    CHECK(*history.head() == 10);
    while (history.undo()) {
    }
    CHECK(*history.head() == 7);
}

TEST_CASE("History keeps no more bytes than allowed, but always the head", "[document][history]") {
    History<int> history(number(0), "Open",
                         [](const int& value, const int&) { return static_cast<std::size_t>(value); },
                         {.steps = 100, .bytes = 100});
    history.commit(number(40), "a");
    history.commit(number(50), "b");
    CHECK(history.steps().size() == 3);
    history.commit(number(30), "c"); // 120: the first goes, and with it "a" is no longer paid for
    CHECK(history.steps().size() == 3);
    CHECK(*history.steps().front().value == 40);
    history.commit(number(5000), "huge");
    CHECK(*history.head() == 5000);
    CHECK(history.steps().size() == 1);
}

TEST_CASE("The cost of a scene counts shared meshes once", "[document][history]") {
    Scene scene;
    scene.bones.push_back({"a", mesh_of(1000), {}});
    Scene more = scene;
    more.bones.push_back({"b", mesh_of(500), {}});
    const std::size_t same = unshared_bytes(scene, scene);
    CHECK(same < 1000 * sizeof(Vec3));
    const std::size_t added = unshared_bytes(more, scene);
    CHECK(added >= 500 * sizeof(Vec3));
    CHECK(added < 1000 * sizeof(Vec3));
}

TEST_CASE("A document knows whether it is changed, and edits count as one step", "[document][history]") {
    Document document{Scene{}};
    CHECK_FALSE(document.dirty());
    CHECK_FALSE(document.commit("nothing"));
    const ScenePtr before = document.head();
    const auto version = document.version();
    document.edit().name = "one";
    document.edit().name = "two";
    CHECK(document.version() > version);
    CHECK(document.dirty());
    CHECK(document.head() == before);
    REQUIRE(document.commit("Rename"));
    CHECK(document.head()->name == "two");
    CHECK(document.history().steps().size() == 2);
    document.mark_saved("x.fascicle");
    CHECK_FALSE(document.dirty());
    REQUIRE(document.undo());
    CHECK(document.dirty());
    CHECK(document.scene().name == before->name);
    REQUIRE(document.redo());
    CHECK_FALSE(document.dirty());
}

TEST_CASE("Undo during an edit takes back the edit alone", "[document][history]") {
    Document document{Scene{}};
    document.edit().name = "committed";
    document.commit("Rename");
    document.edit().name = "held";
    REQUIRE(document.undo());
    CHECK(document.scene().name == "committed");
    CHECK(document.history().can_undo());
    CHECK_FALSE(document.has_uncommitted_edits());
}
