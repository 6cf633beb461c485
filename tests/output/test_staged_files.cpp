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
