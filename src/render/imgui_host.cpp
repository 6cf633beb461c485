#include "render/imgui_host.hpp"

#include <algorithm>
#include <cmath>
#include <imgui.h>

namespace fascicle::render {
namespace fs = std::filesystem;

namespace {

// Latin with the letters of European names, Greek, general punctuation, super- and subscripts, arrows,
// mathematical signs.
constexpr ImWchar text_ranges[] = {0x0020, 0x017f, 0x0370, 0x03ff, 0x2010, 0x203a, 0x2070,
                                   0x2094, 0x2190, 0x2193, 0x2200, 0x2265, 0};
constexpr ImWchar icon_ranges[] = {0xf000, 0xf2e0, 0};

// ImGui aborts on a missing file, so look first.
fs::path first_existing(const std::vector<fs::path>& paths) {
    std::error_code ignored;
    for (const fs::path& path : paths)
        if (fs::is_regular_file(path, ignored))
            return path;
    return {};
}

} // namespace

ImguiFonts default_imgui_fonts() {
    return {{"/usr/share/fonts/truetype/roboto/unhinted/RobotoTTF/Roboto-Regular.ttf",
             "/usr/share/fonts/truetype/roboto/hinted/Roboto-Regular.ttf",
             "/usr/share/fonts/TTF/Roboto-Regular.ttf", "/usr/share/fonts/google-roboto/Roboto-Regular.ttf"},
            {"/usr/share/fonts/truetype/roboto/unhinted/RobotoTTF/Roboto-Medium.ttf",
             "/usr/share/fonts/truetype/roboto/hinted/Roboto-Medium.ttf",
             "/usr/share/fonts/TTF/Roboto-Medium.ttf", "/usr/share/fonts/google-roboto/Roboto-Medium.ttf"},
            {"/usr/share/fonts/truetype/font-awesome/fontawesome-webfont.ttf",
             "/usr/share/fonts-font-awesome/fonts/fontawesome-webfont.ttf",
             "/usr/share/fonts/fontawesome/fontawesome-webfont.ttf"},
            15.0f};
}

ImguiHost::ImguiHost(float scale, ImguiFonts fonts)
    : fonts_(std::move(fonts)), style_(std::make_unique<ImGuiStyle>()) {
    IMGUI_CHECKVERSION();
    context_ = ImGui::CreateContext();
    ImGui::SetCurrentContext(context_);
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::GetIO().LogFilename = nullptr;
    *style_ = ImGui::GetStyle();
    scale_ = 0.0f;
    set_scale(scale);
}

ImguiHost::~ImguiHost() {
    ImGui::DestroyContext(context_);
}

void ImguiHost::set_scale(float scale) {
    scale = std::clamp(scale, 0.5f, 4.0f);
    if (scale == scale_)
        return;
    scale_ = scale;
    build_fonts();
    apply_style();
}

void ImguiHost::set_style(const ImGuiStyle& style) {
    *style_ = style;
    apply_style();
}

void ImguiHost::apply_style() {
    ImGui::GetStyle() = *style_;
    ImGui::GetStyle().ScaleAllSizes(scale_);
}

void ImguiHost::build_fonts() {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    atlas.Clear();
    atlas.SetTexID(nullptr); // tells ImguiRenderer to fetch the new one
    const float size = std::round(fonts_.size_px * scale_);
    const fs::path text = first_existing(fonts_.text);
    const fs::path icons = first_existing(fonts_.icons);
    ImFontConfig text_config;
    text_config.OversampleH = 2;
    text_config.OversampleV = 1;
    ImFont* font =
        text.empty() ? nullptr : atlas.AddFontFromFileTTF(text.c_str(), size, &text_config, text_ranges);
    has_text_font_ = font != nullptr;
    if (font == nullptr) {
        ImFontConfig built_in;
        built_in.SizePixels = size;
        atlas.AddFontDefault(&built_in);
    }
    has_icons_ = false;
    if (!icons.empty()) {
        ImFontConfig icon_config;
        icon_config.MergeMode = true;
        icon_config.GlyphMinAdvanceX = size; // icons in one column line up
        icon_config.PixelSnapH = true;
        has_icons_ = atlas.AddFontFromFileTTF(icons.c_str(), std::round(size * 14.0f / 15.0f), &icon_config,
                                              icon_ranges) != nullptr;
    }
    const fs::path heading = first_existing(fonts_.headings);
    heading_font_ = text.empty() || heading.empty()
                        ? atlas.Fonts[0]
                        : atlas.AddFontFromFileTTF(heading.c_str(), size, &text_config, text_ranges);
    atlas.Build();
}

} // namespace fascicle::render
