#include "fascicle/io/gif_file.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/io/files.hpp"

#include <algorithm>
#include <cmath>
#include <gif_lib.h>
#include <string>
#include <utility>

namespace fascicle {

namespace {

/// Bayer's 8 x 8 pattern as offsets in [-0.5, 0.5).
double pattern(int x, int y) {
    int value = 0;
    for (int bit = 0; bit < 3; ++bit) {
        const int a = (x >> bit & 1) ^ (y >> bit & 1), b = y >> bit & 1;
        value |= (a << 1 | b) << (2 * (2 - bit));
    }
    return (value + 0.5) / 64 - 0.5;
}

/// Hundredths of a second up to picture k, rounded: so the delays add up to the right time.
long time_of(int k, double fps) {
    return std::lround(k * 100.0 / fps);
}

int write_bytes(GifFileType* gif, const GifByteType* bytes, int count) {
    AtomicFile& file = *static_cast<AtomicFile*>(gif->UserData);
    file.write(bytes, static_cast<std::size_t>(count));
    return file.stream() ? count : 0;
}

} // namespace

struct GifWriter::Impl {
    std::string name;
    AtomicFile file;
    int width, height;
    GifPalette palette;
    GifOptions options;
    int transparent; ///< index that means: as before
    ColorMapObject* colours = nullptr;
    GifFileType* gif = nullptr;
    std::vector<std::uint8_t> shown, next, line;

    Impl(const std::filesystem::path& path, int w, int h, GifPalette p, const GifOptions& o)
        : name(path.string()), file(path), width(w), height(h), palette(std::move(p)), options(o),
          transparent(static_cast<int>(palette.colours().size())) {}
    ~Impl() {
        if (gif != nullptr)
            EGifCloseFile(gif, nullptr);
        if (colours != nullptr)
            GifFreeMapObject(colours);
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    [[noreturn]] void fail(int code) const {
        const char* reason = GifErrorString(code);
        throw_error(name,
                    std::string("cannot write the GIF (") + (reason != nullptr ? reason : "unknown") + ")",
                    "space on the disk");
    }
    void check(int result) const {
        if (result == GIF_ERROR)
            fail(gif->Error);
    }
    void begin();
    void quantise(const std::uint8_t* rgba);
    void write_rectangle(int x0, int y0, int x1, int y1, int delay, bool first);
};

void GifWriter::Impl::begin() {
    const int count = 1 << GifBitSize(transparent + 1);
    colours = GifMakeMapObject(count, nullptr);
    if (colours == nullptr)
        fail(E_GIF_ERR_NOT_ENOUGH_MEM);
    for (std::size_t i = 0; i < palette.colours().size(); ++i) {
        const Rgb8& c = palette.colours()[i];
        colours->Colors[i] = {c[0], c[1], c[2]};
    }
    int error = 0;
    gif = EGifOpen(&file, write_bytes, &error);
    if (gif == nullptr)
        fail(error);
    EGifSetGifVersion(gif, true);
    check(EGifPutScreenDesc(gif, width, height, 8, 0, colours));
    const GifByteType repeat[3] = {1, 0, 0}; // for ever
    check(EGifPutExtensionLeader(gif, APPLICATION_EXT_FUNC_CODE));
    check(EGifPutExtensionBlock(gif, 11, "NETSCAPE2.0"));
    check(EGifPutExtensionBlock(gif, 3, repeat));
    check(EGifPutExtensionTrailer(gif));
}

void GifWriter::Impl::quantise(const std::uint8_t* rgba) {
    int offsets[8][8] = {};
    if (options.dither)
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 8; ++x)
                offsets[y][x] = static_cast<int>(std::lround(pattern(x, y) * palette.spacing()));
    std::size_t i = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x, ++i) {
            const int push = offsets[y & 7][x & 7];
            const auto channel = [&](std::size_t c) { return std::clamp(rgba[4 * i + c] + push, 0, 255); };
            next[i] = palette.nearest(channel(0), channel(1), channel(2));
        }
}

void GifWriter::Impl::write_rectangle(int x0, int y0, int x1, int y1, int delay, bool first) {
    GraphicsControlBlock control{};
    control.DisposalMode = DISPOSE_DO_NOT;
    control.DelayTime = delay;
    control.TransparentColor = first ? NO_TRANSPARENT_COLOR : transparent;
    GifByteType bytes[4];
    EGifGCBToExtension(&control, bytes);
    check(EGifPutExtension(gif, GRAPHICS_EXT_FUNC_CODE, 4, bytes));
    check(EGifPutImageDesc(gif, x0, y0, x1 - x0, y1 - y0, false, nullptr));
    line.resize(static_cast<std::size_t>(x1 - x0));
    for (int y = y0; y < y1; ++y) {
        const std::size_t row = static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
        for (int x = x0; x < x1; ++x) {
            const std::size_t i = row + static_cast<std::size_t>(x);
            const bool same = !first && next[i] == shown[i];
            line[static_cast<std::size_t>(x - x0)] = same ? static_cast<std::uint8_t>(transparent) : next[i];
        }
        check(EGifPutLine(gif, line.data(), x1 - x0));
    }
}

GifWriter::GifWriter(const std::filesystem::path& path, int width, int height, GifPalette palette,
                     const GifOptions& options) {
    FASCICLE_ASSERT(width >= 1 && height >= 1 && width <= 65535 && height <= 65535);
    FASCICLE_ASSERT(options.fps > 0 && options.fps <= gif_most_fps);
    impl_ = std::make_unique<Impl>(path, width, height, std::move(palette), options);
    impl_->next.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    impl_->begin();
}

GifWriter::~GifWriter() = default;

void GifWriter::add(const std::uint8_t* rgba) {
    Impl& me = *impl_;
    me.quantise(rgba);
    const bool first = frames_ == 0;
    int x0 = 0, y0 = 0, x1 = me.width, y1 = me.height;
    if (!first) {
        x0 = me.width, y0 = me.height, x1 = y1 = 0;
        for (int y = 0; y < me.height; ++y) {
            const auto row = static_cast<std::ptrdiff_t>(y) * me.width;
            const auto begin = me.next.begin() + row, end = begin + me.width, old = me.shown.begin() + row;
            const auto at = std::mismatch(begin, end, old).first;
            if (at == end)
                continue;
            y0 = std::min(y0, y);
            y1 = y + 1;
            x0 = std::min(x0, static_cast<int>(at - begin));
            int right = me.width;
            while (right > x1 && begin[right - 1] == old[right - 1])
                --right;
            x1 = std::max(x1, right);
        }
        if (y1 == 0) // nothing moved: the smallest picture there can be carries the delay
            x0 = y0 = 0, x1 = y1 = 1;
    }
    const long delay = time_of(frames_ + 1, me.options.fps) - time_of(frames_, me.options.fps);
    me.write_rectangle(x0, y0, x1, y1, static_cast<int>(std::min(delay, 65535l)), first);
    me.shown.swap(me.next);
    me.next.resize(me.shown.size());
    ++frames_;
}

void GifWriter::commit() {
    FASCICLE_ASSERT(frames_ > 0);
    int error = 0;
    const int result = EGifCloseFile(std::exchange(impl_->gif, nullptr), &error);
    if (result == GIF_ERROR)
        impl_->fail(error);
    impl_->file.commit();
}

} // namespace fascicle
