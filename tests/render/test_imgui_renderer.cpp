#include "render/drawing.hpp"
#include "render/gl_functions.hpp"
#include "render/imgui_host.hpp"
#include "render/imgui_renderer.hpp"

#include <catch2/catch.hpp>
#include <imgui.h>

using namespace fascicle::render;
using namespace fascicle::test;

namespace {

// One frame of `panel` on a white picture.
template <class Panel>
Image draw_panel(ImguiRenderer& renderer, int width, int height, Panel&& panel,
                 float framebuffer_scale = 1.0f) {
    const OffscreenTarget target(static_cast<int>(static_cast<float>(width) * framebuffer_scale),
                                 static_cast<int>(static_cast<float>(height) * framebuffer_scale));
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = ImVec2(static_cast<float>(width), static_cast<float>(height));
    io.DisplayFramebufferScale = ImVec2(framebuffer_scale, framebuffer_scale);
    io.DeltaTime = 1.0f / 60.0f;
    for (int frame = 0; frame < 2; ++frame) { // ImGui sizes windows in the first frame
        renderer.new_frame();
        ImGui::NewFrame();
        panel();
        ImGui::Render();
    }
    target.bind();
    gl::ClearColor(1, 1, 1, 1);
    gl::Clear(GL_COLOR_BUFFER_BIT);
    renderer.draw(ImGui::GetDrawData());
    return target.read_back();
}

void begin_panel() {
    ImGui::SetNextWindowPos(ImVec2(10, 10));
    ImGui::SetNextWindowSize(ImVec2(220, 80));
    ImGui::Begin("Muscle");
}

bool light(const std::array<int, 4>& c) {
    return c[0] > 180 && c[1] > 180 && c[2] > 180;
}

} // namespace

TEST_CASE("A panel with text and icons is drawn", "[render][imgui_renderer]") {
    const OsmesaContext context;
    const ImguiHost host;
    ImguiRenderer renderer;
    const auto count_text = [&](const char* text) {
        const Image image = draw_panel(renderer, 240, 100, [&] {
            begin_panel();
            ImGui::TextUnformatted(text);
            ImGui::End();
        });
        int letters = 0; // light pixels inside the dark panel, below its title
        for (int y = 34; y < 86; ++y)
            for (int x = 14; x < 226; ++x)
                letters += light(pixel(image, x, y)) ? 1 : 0;
        return letters;
    };
    const int nothing = count_text(" "), little = count_text("ilium"),
              more = count_text("gluteus maximus 90\u00b0");
    CHECK(nothing == 0);
    CHECK(little > 20);
    CHECK(more > 2 * little);
    if (host.has_icons())
        CHECK(count_text("\uf04b") > 20); // "play"
    CHECK(ImGui::GetIO().IniFilename == nullptr);
    CHECK(gl::GetError() == GL_NO_ERROR);
}

TEST_CASE("Missing font files fall back to the built-in font", "[render][imgui_host]") {
    const OsmesaContext context;
    ImguiFonts fonts;
    fonts.text = {"/nowhere/font.ttf"};
    fonts.icons = {"/nowhere/icons.ttf"};
    const ImguiHost host(1.0f, fonts);
    CHECK_FALSE(host.has_text_font());
    CHECK_FALSE(host.has_icons());
    ImguiRenderer renderer;
    const Image image = draw_panel(renderer, 240, 100, [] {
        begin_panel();
        ImGui::TextUnformatted("built in");
        ImGui::End();
    });
    CHECK(share(image, [](const auto& c) { return c[0] < 120; }) > 0.4);
}

TEST_CASE("The interface scale re-rasterises fonts and scales the style", "[render][imgui_host]") {
    const OsmesaContext context;
    ImguiHost host;
    ImguiRenderer renderer;
    float size = 0, padding = 0;
    const auto panel = [&] {
        begin_panel();
        size = ImGui::GetFontSize();
        padding = ImGui::GetStyle().WindowPadding.x;
        ImGui::TextUnformatted("rest");
        ImGui::End();
    };
    draw_panel(renderer, 240, 100, panel);
    const float size_1 = size, padding_1 = padding;
    host.set_scale(2.0f);
    draw_panel(renderer, 240, 100, panel);
    CHECK(size == Approx(2 * size_1).margin(1));
    CHECK(padding == Approx(2 * padding_1));
    ImGuiStyle theme;
    theme.WindowPadding.x = 5.0f;
    host.set_style(theme);
    draw_panel(renderer, 240, 100, panel);
    CHECK(padding == Approx(10.0f));
    host.set_scale(1.0f);
    draw_panel(renderer, 240, 100, panel);
    CHECK(padding == Approx(5.0f));
    CHECK(size == Approx(size_1));
    CHECK(gl::GetError() == GL_NO_ERROR);
}

TEST_CASE("Textures and clip rectangles reach the picture", "[render][imgui_renderer]") {
    const OsmesaContext context;
    const ImguiHost host;
    ImguiRenderer renderer;
    const OffscreenTarget picture(8, 8);
    picture.bind();
    gl::ClearColor(0, 1, 0, 1);
    gl::Clear(GL_COLOR_BUFFER_BIT);
    for (const float scale : {1.0f, 2.0f}) {
        const Image image = draw_panel(
            renderer, 100, 60,
            [&] {
                ImDrawList* list = ImGui::GetForegroundDrawList();
                list->AddImage(texture_id(picture.texture()), ImVec2(10, 10), ImVec2(30, 30));
                list->PushClipRect(ImVec2(50, 0), ImVec2(60, 20));
                list->AddRectFilled(ImVec2(40, 10), ImVec2(90, 50), IM_COL32(255, 0, 0, 255));
                list->PopClipRect();
            },
            scale);
        const auto at = [&](float x, float y) {
            return pixel(image, static_cast<int>(x * scale), static_cast<int>(y * scale));
        };
        CHECK(at(20, 20) == std::array{0, 255, 0, 255});
        CHECK(at(35, 20) == std::array{255, 255, 255, 255});
        CHECK(at(55, 15) == std::array{255, 0, 0, 255});
        CHECK(at(55, 25) == std::array{255, 255, 255, 255});
        CHECK(at(45, 15) == std::array{255, 255, 255, 255});
    }
}

TEST_CASE("More than 65,536 vertices in one list are drawn", "[render][imgui_renderer]") {
    const OsmesaContext context;
    const ImguiHost host;
    ImguiRenderer renderer;
    const Image image = draw_panel(renderer, 200, 100, [&] {
        ImDrawList* list = ImGui::GetForegroundDrawList();
        for (int i = 0; i < 20000; ++i) { // 80,000 vertices over the whole picture
            const auto x = static_cast<float>(i % 200), y = static_cast<float>(i / 200);
            list->AddRectFilled(ImVec2(x, y), ImVec2(x + 1, y + 1), IM_COL32(0, 0, 255, 255));
        }
    });
    CHECK(share(image, [](const auto& c) { return c == std::array{0, 0, 255, 255}; }) == 1.0);
}
