#include "render/text_raster.hpp"

#include <cmath>
#include <fstream>
#include <iterator>

#define STB_TRUETYPE_IMPLEMENTATION
#define STBTT_STATIC
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb_truetype.h>
#pragma GCC diagnostic pop

namespace fascicle::render {

struct TextRaster::Font {
    std::string bytes; ///< info points into them
    stbtt_fontinfo info{};

    double advance(const std::vector<int>& codes, std::size_t i, float factor) const {
        int wide = 0, bearing = 0;
        stbtt_GetCodepointHMetrics(&info, codes[i], &wide, &bearing);
        if (i + 1 < codes.size())
            wide += stbtt_GetCodepointKernAdvance(&info, codes[i], codes[i + 1]);
        return double(factor) * wide;
    }
    float factor(double size) const {
        return stbtt_ScaleForMappingEmToPixels(&info, static_cast<float>(size));
    }
};

namespace {

/// Code points of UTF-8; what is none becomes '?'.
std::vector<int> code_points(const std::string& text) {
    std::vector<int> points;
    for (std::size_t i = 0; i < text.size();) {
        const auto c = static_cast<unsigned char>(text[i]);
        const std::size_t length = c < 0x80 ? 1 : c >= 0xf0 ? 4 : c >= 0xe0 ? 3 : c >= 0xc0 ? 2 : 0;
        if (length == 0 || i + length > text.size()) {
            points.push_back('?');
            ++i;
            continue;
        }
        int code = length == 1 ? c : c & (0xff >> (length + 1));
        for (std::size_t j = 1; j < length; ++j)
            code = code << 6 | (static_cast<unsigned char>(text[i + j]) & 0x3f);
        points.push_back(code);
        i += length;
    }
    return points;
}

} // namespace

TextRaster::TextRaster(const std::vector<std::filesystem::path>& candidates) {
    for (const std::filesystem::path& path : candidates) {
        std::ifstream in(path, std::ios::binary);
        auto font = std::make_unique<Font>();
        font->bytes.assign(std::istreambuf_iterator<char>(in), {});
        const auto* data = reinterpret_cast<const unsigned char*>(font->bytes.data());
        if (!font->bytes.empty() &&
            stbtt_InitFont(&font->info, data, stbtt_GetFontOffsetForIndex(data, 0)) != 0) {
            font_ = std::move(font);
            return;
        }
    }
}

TextRaster::~TextRaster() = default;

bool TextRaster::ready() const {
    return font_ != nullptr;
}

double TextRaster::width(const std::string& text, double size) const {
    if (font_ == nullptr)
        return 0;
    const std::vector<int> codes = code_points(text);
    double width = 0;
    for (std::size_t i = 0; i < codes.size(); ++i)
        width += font_->advance(codes, i, font_->factor(size));
    return width;
}

void TextRaster::draw(const std::string& text, double size, double x, double y,
                      const std::function<void(int, int, float)>& cover) const {
    if (font_ == nullptr)
        return;
    const float factor = font_->factor(size);
    const std::vector<int> codes = code_points(text);
    for (std::size_t i = 0; i < codes.size(); ++i) {
        int w = 0, h = 0, dx = 0, dy = 0;
        const double whole = std::floor(x);
        unsigned char* const glyph = stbtt_GetCodepointBitmapSubpixel(
            &font_->info, factor, factor, static_cast<float>(x - whole), 0, codes[i], &w, &h, &dx, &dy);
        for (int r = 0; r < h; ++r)
            for (int c = 0; c < w; ++c)
                if (glyph[r * w + c] != 0)
                    cover(static_cast<int>(whole) + dx + c, static_cast<int>(y) + dy + r,
                          static_cast<float>(glyph[r * w + c]) / 255.0f);
        stbtt_FreeBitmap(glyph, nullptr);
        x += font_->advance(codes, i, factor);
    }
}

} // namespace fascicle::render
