#include "fascicle/base/error.hpp"
#include "fascicle/io/files.hpp"
#include "output/staged_files.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::output;
using fascicle::test::TempDir;
namespace fs = std::filesystem;

TEST_CASE("Staged files appear together, and a longer series of before goes", "[output][unit]") {
    const TempDir folder;
    const fs::path out = folder.path() / "new" / "out";
    const Scene scene;
    for (const int last : {3, 1}) {
        StagedFiles files(out);
        for (int k = 0; k <= last; ++k)
            write_file(files.place() / "frames" / ("m.000" + std::to_string(k) + ".vtp"),
                       std::to_string(last));
        write_file(files.place() / "table.csv", "x");
        CHECK(fs::exists(out / "frames") == (last == 1));
        files.commit(scene);
        if (last == 3)
            write_file(out / "frames" / "other.0009.vtp", "a user's own");
    }
    CHECK(read_file(out / "frames" / "m.0001.vtp") == "1");
    CHECK_FALSE(fs::exists(out / "frames" / "m.0002.vtp"));
    CHECK(fs::exists(out / "frames" / "other.0009.vtp"));
    CHECK(std::distance(fs::directory_iterator(out), fs::directory_iterator()) == 2); // frames, table.csv
}

TEST_CASE("Staged files that are given up leave no file and no folder", "[output][unit]") {
    const TempDir folder;
    {
        StagedFiles files(folder.path() / "a" / "b");
        write_file(files.place() / "c" / "x.txt", "x");
    }
    CHECK(fs::is_empty(folder.path()));
    write_file(folder.path() / "kept" / "y.txt", "y");
    { const StagedFiles files(folder.path() / "kept"); }
    CHECK(fs::exists(folder.path() / "kept" / "y.txt"));
    CHECK_THROWS_AS(StagedFiles("/proc/no"), Error);
}

TEST_CASE("Staged files never replace what the scene was read from", "[output][unit]") {
    const TempDir folder;
    write_file(folder.path() / "muscle.obj", "input");
    Scene scene;
    Muscle muscle;
    muscle.source.path = (folder.path() / "muscle.obj").string();
    scene.muscles.push_back(muscle);
    {
        StagedFiles files(folder.path());
        write_file(files.place() / "a.txt", "new");
        write_file(files.place() / "muscle.obj", "output");
        CHECK_THROWS_AS(files.commit(scene), Error);
    }
    CHECK(read_file(folder.path() / "muscle.obj") == "input");
    CHECK_FALSE(fs::exists(folder.path() / "a.txt"));
    CHECK_THROWS_AS(check_no_input(folder.path() / "." / "muscle.obj", scene), Error);
    CHECK_NOTHROW(check_no_input(folder.path() / "other.obj", scene));
}

TEST_CASE("Staged files that cannot all be moved put back what was there", "[output][unit]") {
    const TempDir folder;
    const fs::path out = folder.path() / "out";
    write_file(out / "a.txt", "old");
    write_file(out / "summary.json", "old");
    fs::create_directories(out / "z.txt"); // in the way
    {
        StagedFiles files(out);
        for (const char* name : {"a.txt", "b/c.txt", "summary.json", "z.txt"})
            write_file(files.place() / name, "new");
        CHECK_THROWS_WITH(files.commit(Scene()), Catch::Contains("z.txt: cannot write: is a folder"));
    }
    CHECK(read_file(out / "a.txt") == "old");
    CHECK(read_file(out / "summary.json") == "old");
    CHECK_FALSE(fs::exists(out / "b"));
    CHECK(std::distance(fs::directory_iterator(out), fs::directory_iterator()) == 3);
}

TEST_CASE("Staged files follow no link out of their folder", "[output][unit]") {
    const TempDir folder;
    const fs::path out = folder.path() / "out", elsewhere = folder.path() / "elsewhere";
    fs::create_directories(out);
    fs::create_directories(elsewhere);
    fs::create_directory_symlink(elsewhere, out / "frames");
    StagedFiles files(out);
    write_file(files.place() / "frames" / "x.vtp", "x");
    CHECK_THROWS_WITH(files.commit(Scene()), Catch::Contains("is a link to another folder"));
    CHECK(fs::is_empty(elsewhere));
}

TEST_CASE("One program at a time stages files for a folder, unless it is shared", "[output][unit]") {
    const TempDir folder;
    {
        const StagedFiles files(folder.path());
        CHECK_THROWS_WITH(StagedFiles(folder.path()), Catch::Contains("another program is writing"));
        CHECK_NOTHROW(StagedFiles(folder.path(), StagedFiles::Use::shared));
    }
    CHECK_NOTHROW(StagedFiles(folder.path()));
    // What a program left that is no longer there goes; what may be somebody's stays.
    fs::create_directories(folder.path() / ".fascicle-part-999999999-0" / "frames");
    fs::create_directories(folder.path() / ".fascicle-part-1-0");
    fs::create_directories(folder.path() / ".fascicle-part-mine");
    CHECK_NOTHROW(StagedFiles(folder.path()));
    CHECK(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()) == 2);
}
