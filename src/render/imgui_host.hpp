#pragma once
// Owns the one ImGui context of the process: fonts, scale of the interface, no files of its own.

#include <filesystem>
#include <memory>
#include <vector>

struct ImFont;
struct ImGuiContext;
struct ImGuiStyle;

namespace fascicle::render {

/// Font files tried in turn; the first that exists is used.
struct ImguiFonts {
    std::vector<std::filesystem::path> text;
    std::vector<std::filesystem::path> headings; ///< a heavier cut of the same; none: headings look like text
    std::vector<std::filesystem::path> icons;    ///< Font Awesome 4.7, merged in at U+F000 to U+F2E0
    float size_px = 15.0f;                       ///< at scale 1
};

/// Where Linux distributions keep Roboto and Font Awesome.
ImguiFonts default_imgui_fonts();

class ImguiHost {
public:
    /// Makes the context current. scale: 1 = 96 dpi, kept within 0.5 to 4. Without a text font ImGui's
    /// built-in one serves, without an icon font icons are missing (has_icons()).
    explicit ImguiHost(float scale = 1.0f, ImguiFonts fonts = default_imgui_fonts());
    ~ImguiHost();
    ImguiHost(const ImguiHost&) = delete;
    ImguiHost& operator=(const ImguiHost&) = delete;

    /// Between two frames: re-rasterises the fonts and scales the style.
    void set_scale(float scale);
    /// Between two frames: a style made for scale 1 (theme); shown at the present scale.
    void set_style(const ImGuiStyle& style);
    float scale() const { return scale_; }
    bool has_text_font() const { return has_text_font_; }
    bool has_icons() const { return has_icons_; }
    /// For titles; valid until the next set_scale().
    ImFont* heading_font() const { return heading_font_; }

private:
    void build_fonts();
    void apply_style();

    ImguiFonts fonts_;
    float scale_ = 1.0f;
    bool has_text_font_ = false, has_icons_ = false;
    ImFont* heading_font_ = nullptr;
    ImGuiContext* context_ = nullptr;
    std::unique_ptr<ImGuiStyle> style_; ///< at scale 1
};

} // namespace fascicle::render
