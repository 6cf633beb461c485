#include "editor/layout.hpp"

#include <catch2/catch.hpp>

using namespace fascicle::editor;

namespace {

bool overlap(const Rect& a, const Rect& b) {
    return !a.empty() && !b.empty() && a.min.x < b.max.x && b.min.x < a.max.x && a.min.y < b.max.y &&
           b.min.y < a.max.y;
}

} // namespace

TEST_CASE("The parts of the window never overlap nor leave it", "[editor][layout]") {
    for (const float width : {320.f, 500.f, 800.f, 1280.f, 2560.f})
        for (const float height : {240.f, 400.f, 800.f, 1600.f})
            for (const float scale : {0.75f, 1.f, 2.f, 3.f}) {
                INFO(width << " x " << height << " at " << scale);
                const Layout l = compute_layout(width, height, {}, scale);
                const std::vector<Rect> parts{l.menu,       l.toolbar,  l.tree,   l.inspector, l.viewport,
                                              l.parameters, l.timeline, l.bottom, l.status};
                for (std::size_t i = 0; i < parts.size(); ++i) {
                    if (parts[i].empty())
                        continue;
                    CHECK(parts[i].min.x >= 0);
                    CHECK(parts[i].min.y >= 0);
                    CHECK(parts[i].max.x <= width);
                    CHECK(parts[i].max.y <= height);
                    for (std::size_t k = i + 1; k < parts.size(); ++k) {
                        INFO(i << " and " << k);
                        CHECK_FALSE(overlap(parts[i], parts[k]));
                    }
                }
                CHECK_FALSE(l.menu.empty());
            }
}

TEST_CASE("A usual window shows everything, a tiny one keeps the view", "[editor][layout]") {
    const Layout big = compute_layout(1280, 800, {}, 1);
    for (const Rect& part :
         {big.tree, big.inspector, big.viewport, big.parameters, big.timeline, big.bottom, big.status})
        CHECK_FALSE(part.empty());
    CHECK(big.viewport.width() >= 640);
    const Layout tiny = compute_layout(320, 240, {}, 1);
    CHECK_FALSE(tiny.viewport.empty());
    CHECK(tiny.parameters.empty());
    CHECK(tiny.tree.empty());
    LayoutSizes hidden;
    hidden.show_left = hidden.show_right = hidden.show_bottom = false;
    const Layout bare = compute_layout(1280, 800, hidden, 1);
    CHECK(bare.viewport.width() == 1280);
    CHECK(bare.bottom.empty());
}
