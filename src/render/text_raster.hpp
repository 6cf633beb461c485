#pragma once
// Text as pixels, straight from a font file: no graphics context, any size.

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace fascicle::render {

class TextRaster {
public:
    /// The first file that is a font is used.
    explicit TextRaster(const std::vector<std::filesystem::path>& candidates);
    ~TextRaster();
    TextRaster(const TextRaster&) = delete;
    TextRaster& operator=(const TextRaster&) = delete;

    bool ready() const;
    /// UTF-8; size: of the em, pixels. 0 when not ready().
    double width(const std::string& text, double size) const;
    /// Baseline from (x, y), y down, a whole pixel. cover(x, y, 0 to 1) of each pixel that a glyph touches.
    void draw(const std::string& text, double size, double x, double y,
              const std::function<void(int, int, float)>& cover) const;

private:
    struct Font;
    std::unique_ptr<Font> font_; ///< null: not ready
};

} // namespace fascicle::render
