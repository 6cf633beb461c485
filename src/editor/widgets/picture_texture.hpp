#pragma once
// A small picture on a card: a PNG file or a drawn picture as a GL texture.

#include "editor/editor_context.hpp"

#include <filesystem>

namespace fascicle::editor {

class PictureTexture {
public:
    PictureTexture() = default;
    ~PictureTexture();
    PictureTexture(PictureTexture&& other) noexcept { *this = std::move(other); }
    PictureTexture& operator=(PictureTexture&& other) noexcept;

    /// Reads the file the first time. Without a graphics context, or when there is no such file, there is no picture.
    void load(const EditorContext& context, const std::filesystem::path& file);
    /// rgba: 4 * width * height bytes, rows from the top. A GL context must be current.
    void set(int width, int height, const unsigned char* rgba);
    bool empty() const { return name_ == 0; }
    int width() const { return width_; }

    /// Fills the rectangle, cut at the sides that stand over; a plain field with a faint sign when there is none.
    void draw(const EditorContext& context, const Rect& area, float alpha = 1) const;

private:
    unsigned name_ = 0; ///< of GL
    int width_ = 0, height_ = 0;
    std::filesystem::path file_;
    bool tried_ = false;
};

} // namespace fascicle::editor
