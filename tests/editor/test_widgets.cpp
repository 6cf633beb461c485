#include "editor/widgets/paint.hpp"
#include "render/imgui_host.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

using namespace fascicle::editor;

TEST_CASE("Ticks are round numbers inside the range", "[editor][widgets]") {
    for (const double low : {-3.7, 0.0, 0.9971, 1e-5, -2e6})
        for (const double span : {1e-4, 0.37, 1.0, 55.0, 3e6})
            for (int count = 1; count <= 9; ++count) {
                const Ticks t = nice_ticks(low, low + span, count);
                INFO(low << " + " << span << ", " << count);
                CHECK(t.count <= count + 1);
                const double mantissa = t.step / std::pow(10.0, std::floor(std::log10(t.step) + 1e-9));
                CHECK((mantissa == Approx(1) || mantissa == Approx(2) || mantissa == Approx(5)));
                for (int i = 0; i < t.count; ++i) {
                    CHECK(t.at(i) >= low - span * 1e-6);
                    CHECK(t.at(i) <= low + span * (1 + 1e-6));
                }
            }
    CHECK(nice_ticks(1, 1, 5).count == 0);
    CHECK(nice_ticks(0, std::numeric_limits<double>::infinity(), 5).count == 0);
}

TEST_CASE("Numbers show just the digits they need", "[editor][widgets]") {
    CHECK(tick_text(0.5, 0.1) == "0.5");
    CHECK(tick_text(-1e-12, 0.1) == "0.0");
    CHECK(tick_text(100, 50) == "100");
    CHECK(tick_text(1.0025, 0.0005) == "1.0025");
    CHECK(value_text(1.00234) == "1.002");
    CHECK(value_text(0.0512) == "0.0512");
    CHECK(value_text(std::nan("")) == "-");
}

TEST_CASE("Long text is cut at whole characters", "[editor][widgets]") {
    const fascicle::render::ImguiHost host;
    ImGui::GetIO().DisplaySize = {100, 100};
    ImGui::NewFrame();
    const std::string text = "gluteus m\xC3\xA4ximus";
    CHECK(elided(text, 1000) == text);
    for (float width = 0; width < 120; width += 3) {
        const std::string cut = elided(text, width);
        CHECK(text_size(cut).x <= width);
        if (cut != text && cut.size() > 3) {
            const std::string kept = cut.substr(0, cut.size() - 3);
            CHECK(text.compare(0, kept.size(), kept) == 0);
            CHECK((static_cast<unsigned char>(kept.back()) != 0xC3)); // not half of the letter
        }
    }
    ImGui::EndFrame();
}
