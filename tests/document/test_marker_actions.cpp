#include "fascicle/document/actions/marker_actions.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;

namespace {

std::vector<int> frames(const Document& document) {
    std::vector<int> all;
    for (const Marker& marker : document.scene().markers)
        all.push_back(marker.frame);
    return all;
}

} // namespace

TEST_CASE("Markers stay in order, one a frame, one undo step each", "[document][markers]") {
    Document document{Scene{}};
    const std::size_t steps = document.history().steps().size();
    CHECK(actions::add_marker(document, 200));
    CHECK(actions::add_marker(document, 40, "Heel strike"));
    CHECK(actions::add_marker(document, 100));
    CHECK(frames(document) == std::vector<int>{40, 100, 200});
    CHECK(document.scene().markers[2].name == "Marker 1");
    CHECK(document.scene().markers[1].name == "Marker 2");
    CHECK(document.history().steps().size() == steps + 3);
    CHECK(document.history().undo_name() == "Add Marker 2");

    CHECK_FALSE(actions::add_marker(document, 40)); // taken
    CHECK_FALSE(actions::add_marker(document, -1));
    CHECK_FALSE(actions::add_marker(document, document.scene().timeline.last_frame + 1));
    CHECK_FALSE(actions::rename_marker(document, 0, ""));
    CHECK_FALSE(actions::rename_marker(document, 0, "Heel strike"));
    CHECK_FALSE(actions::rename_marker(document, 9, "none"));
    CHECK_FALSE(actions::move_marker(document, 0, 40));
    CHECK_FALSE(actions::move_marker(document, 0, 4000));
    CHECK_FALSE(actions::remove_marker(document, 3));
    CHECK(document.history().steps().size() == steps + 3);
    CHECK_FALSE(document.has_uncommitted_edits());

    CHECK(actions::rename_marker(document, 0, "Toe off"));
    CHECK(actions::move_marker(document, 0, 150));
    CHECK(frames(document) == std::vector<int>{100, 150, 200});
    CHECK(document.scene().markers[1].name == "Toe off");
    CHECK(actions::move_marker(document, 1, 200)); // onto another one
    CHECK(frames(document) == std::vector<int>{100, 200});
    CHECK(document.scene().markers[1].name == "Toe off");
    CHECK(actions::remove_marker(document, 0));
    CHECK(actions::marker_at(document.scene(), 200) == 0);
    CHECK(actions::marker_at(document.scene(), 100) == -1);
    while (document.undo()) {
    }
    CHECK(document.scene().markers.empty());
}
