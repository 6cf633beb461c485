#pragma once
// Moving pictures as GIF, frame by frame: memory does not grow with their number.

#include "fascicle/io/gif_palette.hpp"

#include <filesystem>
#include <memory>

namespace fascicle {

struct GifOptions {
    /// Pictures a second, up to 50: a GIF counts hundredths of a second, and browsers slow down what is faster.
    double fps = 25;
    /// An ordered pattern hides the steps between colours; it stays in place, so that still parts stay still.
    bool dither = true;
};
inline constexpr double gif_most_fps = 50;

/// Writes a GIF that repeats for ever. Of every frame only the rectangle that changed is stored.
class GifWriter {
public:
    /// width, height: 1 to 65535. Error naming the file when it cannot be written.
    GifWriter(const std::filesystem::path& path, int width, int height, GifPalette palette,
              const GifOptions& options);
    /// Without commit() nothing is left behind.
    ~GifWriter();
    GifWriter(const GifWriter&) = delete;
    GifWriter& operator=(const GifWriter&) = delete;

    /// 4 * width * height bytes, rows from the top; alpha is passed over. Error naming the file.
    void add(const std::uint8_t* rgba);
    int frame_count() const { return frames_; }
    /// The file gets its name. At least one frame.
    void commit();

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
    int frames_ = 0;
};

} // namespace fascicle
