#include "fascicle/base/error.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/video_encoder.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <sys/wait.h>
#include <vector>

using namespace fascicle;
using fascicle::test::TempDir;
namespace fs = std::filesystem;

namespace {

/// A program called ffmpeg that does what the test says; $last is the film's file.
fs::path fake_encoder(const fs::path& folder, const std::string& script) {
    const fs::path path = folder / "ffmpeg";
    write_file(path, "#!/bin/sh\nfor last; do :; done\n" + script + "\n");
    fs::permissions(path, fs::perms::owner_all);
    return path;
}

/// $PATH for one test.
class WithPath {
public:
    explicit WithPath(const std::string& path) : before_(std::getenv("PATH")) {
        ::setenv("PATH", path.c_str(), 1);
    }
    ~WithPath() { ::setenv("PATH", before_.c_str(), 1); }
    WithPath(const WithPath&) = delete;
    WithPath& operator=(const WithPath&) = delete;

private:
    std::string before_;
};

std::string message_of(const std::function<void()>& work) {
    try {
        work();
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

bool has_children() {
    return ::waitpid(-1, nullptr, WNOHANG) >= 0;
}

} // namespace

TEST_CASE("The film encoder is found in the path, and only a program counts", "[io][unit]") {
    const TempDir folder;
    const fs::path with = folder.path() / "with", without = folder.path() / "without";
    fs::create_directories(with);
    fs::create_directories(without / "ffmpeg"); // a folder of that name
    {
        const WithPath path(without.string() + "::" + with.string());
        CHECK(find_video_encoder().empty());
        write_file(with / "ffmpeg", "not executable");
        CHECK(find_video_encoder().empty());
        fake_encoder(with, "exit 0");
        CHECK(find_video_encoder() == with / "ffmpeg");
    }
}

TEST_CASE("Raw pictures go to the encoder and its film gets the name", "[io][unit]") {
    const TempDir folder;
    const fs::path encoder = fake_encoder(
        folder.path(), "echo \"$@\" > '" + (folder.path() / "words").string() + "'\ncat > \"$last\"");
    const fs::path film = folder.path() / "a film; rm -rf $HOME.mp4"; // no shell ever reads it
    std::vector<std::uint8_t> picture(4 * 16 * 8);
    {
        VideoEncoder writer(encoder, film, 16, 8, 12.5);
        for (int k = 0; k < 3; ++k) {
            picture.assign(picture.size(), static_cast<std::uint8_t>(k + 1));
            writer.add(picture.data());
        }
        CHECK_FALSE(fs::exists(film));
        writer.commit();
    }
    const std::string bytes = read_file(film);
    REQUIRE(bytes.size() == 3 * picture.size());
    CHECK(bytes[0] == 1);
    CHECK(bytes.back() == 3);
    const std::string words = read_file(folder.path() / "words");
    for (const char* word :
         {"-f rawvideo", "-pix_fmt rgba", "-s 16x8", "-r 12.5", "-c:v libx264", "-pix_fmt yuv420p"})
        CHECK(words.find(word) != std::string::npos);
    CHECK_FALSE(has_children());
}

TEST_CASE("An encoder that gives up is told in one line and leaves no film", "[io][unit]") {
    const TempDir folder;
    const fs::path film = folder.path() / "film.mp4";
    const std::vector<std::uint8_t> picture(4 * 256 * 256); // larger than a pipe holds
    const auto write = [&](const fs::path& encoder) {
        return message_of([&] {
            VideoEncoder writer(encoder, film, 256, 256, 25);
            for (int k = 0; k < 4; ++k)
                writer.add(picture.data());
            writer.commit();
        });
    };
    const std::string early =
        write(fake_encoder(folder.path(), "echo first >&2; echo 'Unknown encoder libx264' >&2; exit 3"));
    CHECK(early.find("Unknown encoder libx264") != std::string::npos);
    CHECK(early.find('\n') == std::string::npos);
    CHECK(early.find("film.mp4") != std::string::npos);
    const std::string late =
        write(fake_encoder(folder.path(), "cat > \"$last\"; echo 'disk full' >&2; exit 1"));
    CHECK(late.find("disk full") != std::string::npos);
    const std::string silent = write(fake_encoder(folder.path(), "cat > /dev/null"));
    CHECK(silent.find("left no film") != std::string::npos);
    CHECK(write(folder.path() / "nothing").find("cannot start") != std::string::npos);
    CHECK_FALSE(has_children());
    int files = 0;
    for (const auto& entry : fs::directory_iterator(folder.path()))
        files += entry.path().filename() != "ffmpeg" ? 1 : 0;
    CHECK(files == 0);
}

TEST_CASE("A film that is given up stops its encoder and leaves nothing", "[io][unit]") {
    const TempDir folder;
    const fs::path encoder = fake_encoder(folder.path(), "echo begun > \"$last\"; exec sleep 60");
    std::atomic<bool> cancel{false};
    const std::vector<std::uint8_t> picture(4 * 256 * 256);
    {
        VideoEncoder writer(encoder, folder.path() / "film.mp4", 256, 256, 25, &cancel);
        cancel = true;
        CHECK_THROWS_AS(writer.add(picture.data()), Cancelled);
    }
    CHECK_FALSE(has_children());
    CHECK(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()) == 1);
}

TEST_CASE("The machine's own encoder makes a film", "[io]") {
    const fs::path encoder = find_video_encoder();
    if (encoder.empty()) {
        WARN("fascicle-skip: there is no ffmpeg");
        return;
    }
    const TempDir folder;
    const std::vector<std::uint8_t> picture(4 * 64 * 48, 200);
    VideoEncoder writer(encoder, folder.path() / "film.mp4", 64, 48, 25);
    for (int k = 0; k < 5; ++k)
        writer.add(picture.data());
    writer.commit();
    const std::string film = read_file(folder.path() / "film.mp4");
    CHECK(film.substr(4, 4) == "ftyp");
}
