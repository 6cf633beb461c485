#include "fascicle/io/png.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/io/files.hpp"

#include <catch2/catch.hpp>
#include <unistd.h>

using namespace fascicle;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

struct Folder {
    Folder() { fs::create_directories(path); }
    ~Folder() { fs::remove_all(path); }
    // CTest runs tests of this file as processes of their own, at the same time.
    fs::path path = fs::temp_directory_path() / ("fascicle_test_png_" + std::to_string(::getpid()));
};

std::vector<std::uint8_t> pattern(int width, int height, bool opaque) {
    std::vector<std::uint8_t> rgba;
    unsigned state = 12345;
    for (int i = 0; i < width * height; ++i) {
        state = state * 1664525u + 1013904223u;
        rgba.insert(rgba.end(), {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(state >> 24),
                                 static_cast<std::uint8_t>(i / width),
                                 opaque ? std::uint8_t{255} : static_cast<std::uint8_t>(state >> 16)});
    }
    return rgba;
}

} // namespace

TEST_CASE("PNG pictures come back byte for byte", "[io][png]") {
    const Folder folder;
    for (const bool opaque : {true, false})
        for (const auto& [width, height] : {std::pair{1, 1}, {37, 11}, {640, 3}}) {
            const std::vector<std::uint8_t> rgba = pattern(width, height, opaque);
            write_png(folder.path / "picture.png", width, height, rgba.data());
            const PngImage back = read_png(folder.path / "picture.png");
            CHECK(back.width == width);
            CHECK(back.height == height);
            CHECK(back.rgba == rgba);
        }
}

TEST_CASE("What is not a whole PNG is an error that names the file", "[io][png]") {
    const Folder folder;
    const fs::path file = folder.path / "picture.png";
    CHECK_THROWS_WITH(read_png(file), Contains("picture.png"));
    write_file(file, "");
    CHECK_THROWS_WITH(read_png(file), Contains("picture.png") && Contains("not a PNG"));
    write_file(file, "P6 2 2 255 something else");
    CHECK_THROWS_WITH(read_png(file), Contains("not a PNG"));

    write_png(file, 64, 64, pattern(64, 64, true).data());
    const std::string whole = read_file(file);
    for (std::size_t length = 0; length < whole.size(); length += 101) {
        write_file(file, whole.substr(0, length));
        CHECK_THROWS_AS(read_png(file), Error);
    }
    std::string large = whole.substr(0, 200);
    large[16] = 0; // 8000x8000 in the header of a small file
    large[17] = 0;
    large[18] = 0x1f;
    large[19] = 0x40;
    large[20] = 0;
    large[21] = 0;
    large[22] = 0x1f;
    large[23] = 0x40;
    write_file(file, large);
    CHECK_THROWS_WITH(read_png(file), Contains("more than its"));
    for (std::size_t at = 0; at < whole.size();
         at += 7) { // damage must not crash; it may go unnoticed (no checksums)
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
        write_file(file, damaged);
        try {
            read_png(file);
        } catch (const Error&) {
        }
    }
}

TEST_CASE("A picture that cannot be written is an error", "[io][png]") {
    const Folder folder;
    const std::uint8_t dot[4] = {1, 2, 3, 255};
    write_file(folder.path / "file", "x");
    CHECK_THROWS_WITH(write_png(folder.path / "file" / "picture.png", 1, 1, dot), Contains("file"));
}
