#include "fascicle/base/error.hpp"
#include "fascicle/io/files.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>
#include <fstream>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace fascicle;
using Catch::Contains;
using fascicle::test::TempDir;
namespace fs = std::filesystem;

TEST_CASE("only regular files are read, and nothing waits for a pipe", "[io][files]") {
    const TempDir dir;
    REQUIRE(::mkfifo((dir.path() / "pipe").c_str(), 0600) == 0);
    CHECK_THROWS_WITH(read_file(dir.path() / "pipe"),
                      Contains("pipe: cannot read: is a pipe; expected a file"));
    CHECK_THROWS_WITH(read_file("/dev/zero"), Contains("is a device"));
    CHECK_THROWS_WITH(read_file(dir.path()), Contains("is a folder"));
    CHECK_THROWS_WITH(read_file(dir.path() / "none" / "x"), Contains("no such file"));
    CHECK_THROWS_WITH(read_file(std::string("a\0b", 3)), Contains("no such file"));
    CHECK(read_head(dir.path() / "pipe", 10).empty());
    CHECK(read_head(dir.path() / "none", 10).empty());
    write_file(dir.path() / "x", "0123456789");
    CHECK(read_head(dir.path() / "x", 4) == "0123");
    CHECK(read_head(dir.path() / "x", 40) == "0123456789");
    CHECK_THROWS_WITH(read_file(dir.path() / "x", 9), Contains("at most 9 bytes"));
    CHECK(read_file(dir.path() / "x", 10) == "0123456789");
    CHECK(read_file("/proc/self/status").find("Name:") == 0); // tells a size of 0
}

TEST_CASE("a file takes the place of files only", "[io][files]") {
    const TempDir dir;
    REQUIRE(::mkfifo((dir.path() / "pipe").c_str(), 0600) == 0);
    fs::create_symlink("/dev/null", dir.path() / "null");
    fs::create_directory(dir.path() / "folder");
    for (const char* name : {"pipe", "null", "folder", "folder/"})
        CHECK_THROWS_WITH(write_file(dir.path() / name, "x"), Contains("cannot write"));
    CHECK(fs::is_character_file("/dev/null"));
    write_file(dir.path() / "real", "mine");
    fs::create_symlink("real", dir.path() / "link");
    write_file(dir.path() / "link", "new"); // the link is replaced, not what it points to
    CHECK(read_file(dir.path() / "real") == "mine");
    CHECK(read_file(dir.path() / "link") == "new");
}

TEST_CASE("an atomic file that is not committed leaves nothing, not even its folders", "[io][files]") {
    const TempDir dir;
    {
        AtomicFile file(dir.path() / "a" / "b" / "x");
        file.stream() << "half";
        CHECK_FALSE(fs::exists(dir.path() / "a" / "b" / "x"));
    }
    CHECK(fs::is_empty(dir.path()));
    write_file(dir.path() / "a" / "y", "y");
    { AtomicFile file(dir.path() / "a" / "b" / "x"); }
    CHECK(fs::exists(dir.path() / "a" / "y"));
    CHECK_FALSE(fs::exists(dir.path() / "a" / "b"));
}

TEST_CASE("an atomic file holds what was streamed, in pieces of any size", "[io][files]") {
    const TempDir dir;
    std::string expected;
    {
        AtomicFile file(dir.path() / std::string(255, 'n')); // the longest name there is
        for (std::size_t size : {1U, 65535U, 2U, 65536U, 70000U, 0U, 200000U, 7U}) {
            const std::string piece(size, static_cast<char>('a' + size % 26));
            file.write(piece.data(), piece.size());
            file.stream().put('|');
            expected += piece + '|';
        }
        file.commit();
    }
    CHECK(read_file(dir.path() / std::string(255, 'n')) == expected);
    CHECK_THROWS_WITH(write_file(dir.path() / std::string(256, 'n'), "x"), Contains("File name too long"));
}

TEST_CASE("a full disk is told with the file and the system's words", "[io][files]") {
    if (!fs::exists("/dev/full"))
        return;
    // A link: the temporary file would lie beside it, so the device itself is what is asked for.
    CHECK_THROWS_WITH(write_file("/dev/full", "x"), Contains("/dev/full: cannot write: is a device"));
    CHECK(shown_path("/a/.fascicle-part-12-0/frames/x") == "/a/frames/x");
    CHECK(shown_path("a/b") == "a/b");
}

TEST_CASE("temporary files of killed programs go with the next file of that name, nothing else does",
          "[io][files]") {
    const TempDir dir;
    const pid_t child = ::fork(); // its number is nobody's once it has been waited for
    REQUIRE(child >= 0);
    if (child == 0)
        ::_exit(0);
    REQUIRE(::waitpid(child, nullptr, 0) == child);
    const std::string dead = std::to_string(child), alive = std::to_string(::getpid());
    const std::vector<std::string> stay = {"out.vtp.part" + alive + "-7",
                                           "out.vtp.part" + dead,
                                           "out.vtp.part" + dead + "-",
                                           "out.vtp.part" + dead + "-0.bak",
                                           "out.vtp.part" + dead + "-0-1",
                                           "out.vtp.part-" + dead + "-1",
                                           "out.vtp.partition",
                                           "other.vtp.part" + dead + "-0",
                                           "out.vtp.part1-0",
                                           "more out.vtp.part" + dead + "-0"};
    const std::vector<std::string> go = {"out.vtp.part" + dead + "-0", "out.vtp.part" + dead + "-12345"};
    for (const auto* names : {&stay, &go})
        for (const std::string& name : *names)
            std::ofstream(dir.path() / name) << "half";
    {
        const AtomicFile file(dir.path() / "out.vtp"); // given up: they go all the same
        for (const std::string& name : go)
            CHECK_FALSE(fs::exists(dir.path() / name));
    }
    for (const std::string& name : stay) {
        INFO(name);
        CHECK(fs::exists(dir.path() / name));
    }
    CHECK(std::distance(fs::directory_iterator(dir.path()), fs::directory_iterator()) ==
          static_cast<std::ptrdiff_t>(stay.size()));
}
