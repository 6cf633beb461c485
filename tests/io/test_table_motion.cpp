#include "fascicle/io/mesh_hints.hpp"
#include "fascicle/io/table_motion.hpp"

#include <catch2/catch.hpp>
#include <numbers>

using namespace fascicle;

namespace {

StorageTable table(const std::string& rows) {
    return read_storage("t\ninDegrees=yes\nendheader\ntime\tangle\n" + rows, "t.mot");
}

constexpr double degree = std::numbers::pi / 180;

} // namespace

TEST_CASE("A column becomes angles, linear between uneven rows", "[io][table_motion]") {
    const StorageTable t = table("1\t10\n1.1\t20\n1.4\t50\n");
    const auto angles = column_angles(t, 1, degree, {0.1, 0});
    REQUIRE(angles.size() == 5);
    CHECK(frame_count(t, {0.1, 0}) == 4);
    for (int k = 0; k < 5; ++k) {
        CHECK(angles[std::size_t(k)].frame == k);
        CHECK(angles[std::size_t(k)].angle_rad ==
              Approx(10 * k * degree).margin(1e-12)); // counted from the first row
    }
    const auto led = column_angles(t, 1, -degree, {0.1, 5});
    REQUIRE(led.size() == 6);
    CHECK(led[0].frame == 0);
    CHECK(led[0].angle_rad == 0);
    CHECK(led[1].frame == 5);
    CHECK(led[1].angle_rad == Approx(-10 * degree));
    CHECK(led[5].angle_rad == Approx(-50 * degree));
}

TEST_CASE("Tables without an ascending time, or of no length, are refused", "[io][table_motion]") {
    CHECK_THROWS_WITH(frame_count(table("0\t1\n0\t2\n"), {0.1, 0}),
                      Catch::Contains("line 6: the time does not ascend"));
    CHECK_THROWS_WITH(frame_count(table("0\t1\n"), {0.1, 0}), Catch::Contains("it makes 0 frames"));
    CHECK_THROWS_WITH(frame_count(table("0\t1\n1e9\t2\n"), {0.1, 0}), Catch::Contains("1 to 100000 frames"));
    CHECK_THROWS_WITH(column_angles(table("0\t1\n1\tnan\n"), 1, 1, {0.1, 0}),
                      Catch::Contains("'angle' is not a finite number"));
    const StorageTable no_time = read_storage("t\nendheader\na\tb\n1\t2\n", "t.mot");
    CHECK_THROWS_WITH(frame_count(no_time, {0.1, 0}), Catch::Contains("no column 'time'"));
}

TEST_CASE("Headers of mesh files are looked through for frame and unit", "[io][mesh_hints]") {
    CHECK(find_mesh_hints("# vtk DataFile Version 3.0\nSPACE=RAS\nASCII\n").space == MeshSpace::ras);
    CHECK(find_mesh_hints("comment space=lps\n").space == MeshSpace::lps);
    CHECK(find_mesh_hints("# 1 unit = 1000.000000 mm\nv 0 0 0\n").millimetres == 1000.0);
    CHECK(find_mesh_hints("# 1 unit = 1 inch\n# 1 unit = 25.4 mm\n").millimetres == 25.4);
    CHECK(find_mesh_hints("# 1 unit = -4 mm\n") == MeshHints{});
    CHECK(find_mesh_hints("v 0 0 0\n") == MeshHints{});
    CHECK(find_mesh_hints("") == MeshHints{});
    CHECK(read_mesh_hints("/nowhere/at/all.obj") == MeshHints{});
}
