#include "fascicle/base/error.hpp"
#include "fascicle/io/gif_file.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <gif_lib.h>

using namespace fascicle;
using fascicle::test::TempDir;

namespace {

using Pixels = std::vector<std::uint8_t>;

struct Decoded {
    int width = 0, height = 0;
    std::vector<Pixels> frames; ///< as shown, RGB
    std::vector<int> delays;
    std::vector<long> areas; ///< of the stored rectangles
    bool repeats = false;
};

/// What a viewer shows: rectangles laid over each other.
Decoded decode(const std::filesystem::path& path) {
    int error = 0;
    GifFileType* gif = DGifOpenFileName(path.c_str(), &error);
    REQUIRE(gif != nullptr);
    REQUIRE(DGifSlurp(gif) == GIF_OK);
    Decoded out;
    out.width = gif->SWidth;
    out.height = gif->SHeight;
    Pixels canvas(static_cast<std::size_t>(3 * out.width * out.height));
    for (int k = 0; k < gif->ImageCount; ++k) {
        const SavedImage& image = gif->SavedImages[k];
        GraphicsControlBlock control{};
        REQUIRE(DGifSavedExtensionToGCB(gif, k, &control) == GIF_OK);
        REQUIRE(image.ImageDesc.ColorMap == nullptr); // one palette for all
        for (int e = 0; e < image.ExtensionBlockCount; ++e)
            out.repeats |= image.ExtensionBlocks[e].Function == APPLICATION_EXT_FUNC_CODE;
        const GifImageDesc& d = image.ImageDesc;
        for (int y = 0; y < d.Height; ++y)
            for (int x = 0; x < d.Width; ++x) {
                const int index = image.RasterBits[y * d.Width + x];
                if (index == control.TransparentColor)
                    continue;
                const GifColorType& c = gif->SColorMap->Colors[index];
                std::uint8_t* to = canvas.data() + 3 * ((d.Top + y) * out.width + d.Left + x);
                to[0] = c.Red, to[1] = c.Green, to[2] = c.Blue;
            }
        out.frames.push_back(canvas);
        out.delays.push_back(control.DelayTime);
        out.areas.push_back(static_cast<long>(d.Width) * d.Height);
    }
    DGifCloseFile(gif, &error);
    return out;
}

/// A shaded ball that moves over a gradient.
Pixels picture(int width, int height, int k) {
    Pixels rgba;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double dx = x - 20 - 4 * k, dy = y - 30, r = std::sqrt(dx * dx + dy * dy) / 16;
            std::array<double, 3> c{60.0 + y, 70.0 + y, 90.0 + y};
            if (r < 1)
                c = {230 - 120 * r, 80 - 50 * r, 60 - 40 * r};
            for (const double v : c)
                rgba.push_back(static_cast<std::uint8_t>(v));
            rgba.push_back(255);
        }
    return rgba;
}

/// Root mean square difference of a channel.
double difference(const Pixels& rgb, const Pixels& rgba) {
    double sum = 0;
    for (std::size_t i = 0; i < rgb.size() / 3; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            sum += std::pow(double(rgb[3 * i + c]) - double(rgba[4 * i + c]), 2);
    return std::sqrt(sum / double(rgb.size()));
}

} // namespace

TEST_CASE("A GIF holds the pictures it was given, their number and their times", "[io][unit]") {
    const TempDir folder;
    const auto path = folder.path() / "ball.gif";
    const int width = 120, height = 61, count = 10;
    for (const bool dither : {false, true}) {
        PaletteSampler sampler;
        for (const int k : {0, 5, 9})
            sampler.add(picture(width, height, k).data(), static_cast<std::size_t>(width * height));
        GifWriter writer(path, width, height, sampler.choose(), {30, dither});
        for (int k = 0; k < count; ++k)
            writer.add(picture(width, height, k).data());
        CHECK(writer.frame_count() == count);
        CHECK_FALSE(std::filesystem::exists(path.string() + "x"));
        writer.commit();
        const Decoded gif = decode(path);
        CHECK(gif.width == width);
        CHECK(gif.height == height);
        CHECK(gif.repeats);
        REQUIRE(gif.frames.size() == count);
        int time = 0;
        for (int k = 0; k < count; ++k) {
            const auto i = static_cast<std::size_t>(k);
            INFO("frame " << k << ", dither " << dither);
            CHECK(difference(gif.frames[i], picture(width, height, k)) < (dither ? 4.0 : 2.5));
            time += gif.delays[i];
            CHECK(std::abs(time - (k + 1) * 100 / 30.0) <= 0.5); // hundredths of a second
            if (k > 0)
                CHECK(gif.areas[i] <= 40 * 34); // the ball's old and new place, not the picture
        }
        std::filesystem::remove(path);
    }
}

TEST_CASE("A GIF of a still scene stays still", "[io][unit]") {
    const TempDir folder;
    const auto path = folder.path() / "still.gif";
    PaletteSampler sampler;
    const Pixels same = picture(64, 64, 2);
    sampler.add(same.data(), 64 * 64);
    GifWriter writer(path, 64, 64, sampler.choose(), {});
    for (int k = 0; k < 3; ++k)
        writer.add(same.data());
    writer.commit();
    const Decoded gif = decode(path);
    REQUIRE(gif.frames.size() == 3);
    CHECK(gif.frames[1] == gif.frames[0]);
    CHECK(gif.frames[2] == gif.frames[0]);
    CHECK(gif.areas[1] == 1);
    CHECK(gif.delays == std::vector<int>{4, 4, 4});
}

TEST_CASE("A GIF that is not committed leaves nothing", "[io][unit]") {
    const TempDir folder;
    {
        GifWriter writer(folder.path() / "never.gif", 8, 8, GifPalette({Rgb8{1, 2, 3}}), {});
        writer.add(Pixels(8 * 8 * 4, 9).data());
    }
    CHECK(std::filesystem::is_empty(folder.path()));
    CHECK_THROWS_AS(GifWriter("/proc/no/never.gif", 8, 8, GifPalette({Rgb8{1, 2, 3}}), {}), Error);
}

TEST_CASE("A palette has every colour of a picture with few, and keeps rare ones of a picture with many",
          "[io][unit]") {
    PaletteSampler few;
    Pixels flags;
    for (int i = 0; i < 300; ++i)
        for (const int v : {i % 3 == 0 ? 255 : 0, i % 3 == 1 ? 255 : 0, i % 3 == 2 ? 255 : 0, 255})
            flags.push_back(static_cast<std::uint8_t>(v));
    few.add(flags.data(), 300);
    CHECK(few.choose().colours() == std::vector<Rgb8>{{0, 0, 255}, {0, 255, 0}, {255, 0, 0}});

    PaletteSampler many;
    Pixels grey;
    for (int i = 0; i < 100000; ++i)
        for (const int v : {i % 256, i % 256, i % 256, 255})
            grey.push_back(static_cast<std::uint8_t>(v));
    for (int i = 0; i < 20; ++i)
        for (const int v : {250, 20, 30, 255})
            grey.push_back(static_cast<std::uint8_t>(v));
    many.add(grey.data(), grey.size() / 4);
    GifPalette palette = many.choose(32);
    CHECK(palette.colours().size() == 32);
    const Rgb8 red = palette.colours()[palette.nearest(250, 20, 30)];
    CHECK(std::abs(red[0] - 250) < 6);
    CHECK(std::abs(red[1] - 20) < 6);
    CHECK(PaletteSampler().choose().colours().size() == 1);
}
