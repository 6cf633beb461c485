#include "fascicle/base/error.hpp"
#include "fascicle/io/storage_file.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace fascicle;

namespace {

Skeleton two_coordinates() {
    Skeleton s;
    s.coordinates.resize(2);
    s.coordinates[0].name = "hip";
    s.coordinates[1].name = "slide";
    s.coordinates[1].kind = CoordinateKind::translational;
    s.coordinates[1].default_value = 0.25;
    return s;
}

} // namespace

TEST_CASE("storage: header of OpenSim, tabs, trailing tabs, Windows line ends", "[io][storage]") {
    const StorageTable t =
        read_storage("walk\t\t\r\nversion=1\r\nnRows=2\r\nnColumns=3\r\ninDegrees=yes\r\n\r\nsome words\r\n"
                     "ENDHEADER\t\r\ntime\thip\tslide\t\r\n0\t90\t0.1\t\r\n\r\n0.5\t-9e1\t0.2\r\n",
                     "walk.mot");
    CHECK(t.name == "walk");
    CHECK(t.in_degrees);
    CHECK(t.columns == std::vector<std::string>{"time", "hip", "slide"});
    REQUIRE(t.row_count() == 2);
    CHECK(t.value(1, 1) == -90);
    CHECK(t.lines == std::vector<std::size_t>{10, 12});
    CHECK(t.notes.empty());
    const Skeleton skeleton = two_coordinates();
    std::vector<double> q;
    coordinate_values(t, match_coordinates(t, skeleton), 1, skeleton, q);
    CHECK(q[0] == Approx(-std::numbers::pi / 2)); // degrees turn to radians, shifts stay
    CHECK(q[1] == 0.2);
}

TEST_CASE("storage: header of SIMM, blanks, no unit of angles", "[io][storage]") {
    const StorageTable t =
        read_storage("name trial 1\ndatacolumns 2\ndatarows 7\notherdata 1\nrange 0 1\nendheader\n"
                     "  time   hip  \n 0.0   45 \n",
                     "simm.mot");
    CHECK(t.in_degrees);
    REQUIRE(t.notes.size() == 2);
    CHECK(t.notes[0].find("degrees") != std::string::npos);
    CHECK(t.notes[1].find("7 rows, there are 1") != std::string::npos);
}

TEST_CASE("storage: radians unless somebody says degrees", "[io][storage]") {
    const auto degrees = [](const std::string& header) {
        return read_storage(header + "endheader\ntime hip\n0 1\n", "x.sto").in_degrees;
    };
    CHECK_FALSE(degrees("x\n"));
    CHECK_FALSE(degrees("x\ninDegrees=no\nAngles are in degrees.\n"));
    CHECK(degrees("x\nAngles are in degrees.\n"));
    CHECK(degrees("x\nInDegrees = YES\n"));
}

TEST_CASE("storage: without an end of the header the names begin with time", "[io][storage]") {
    const StorageTable t = read_storage("\xef\xbb\xbf"
                                        "anything\nTime\tleft hip\n0\t1\n",
                                        "x.mot");
    CHECK(t.columns == std::vector<std::string>{"Time", "left hip"});
    CHECK(t.value(0, 1) == 1);
    CHECK(read_storage("time hip\n0 1\n", "x.mot").name.empty());
}

TEST_CASE("storage: states of OpenSim 4 by path, defaults, columns of nobody", "[io][storage]") {
    const StorageTable t = read_storage("s\ninDegrees=no\nendheader\ntime /jointset/hip/hip/value "
                                        "/jointset/hip/hip/speed fx fx\n0 1.5 9 nan 1\n",
                                        "s.sto");
    const Skeleton skeleton = two_coordinates();
    const CoordinateColumns columns = match_coordinates(t, skeleton);
    CHECK(columns.column_of == std::vector<int>{1, -1});
    REQUIRE(columns.notes.size() == 2);
    CHECK(columns.notes[0].find("slide") != std::string::npos);
    CHECK(columns.notes[1].find("fx") != std::string::npos);
    std::vector<double> q;
    coordinate_values(t, columns, 0, skeleton, q);
    CHECK(q == std::vector<double>{1.5, 0.25});
    CHECK(std::isnan(t.value(0, 3)));
    REQUIRE(t.notes.size() == 1);
    CHECK(t.notes[0].find("'fx'") != std::string::npos);
    CHECK(t.column_index("fx") == 3);
    CHECK(t.column_index("fy") == -1);
}

TEST_CASE("storage: what is wrong is told with its line", "[io][storage]") {
    const auto fails = [](const std::string& text, const std::string& part) {
        INFO(text);
        CHECK_THROWS_WITH(read_storage(text, "bad.mot"), Catch::Contains("bad.mot") && Catch::Contains(part));
    };
    fails("", "no header");
    fails("x\nnRows=3\n", "no header");
    fails("x\nendheader\n", "before the names");
    fails("x\nendheader\ntime hip\n", "no rows");
    fails("x\nendheader\ntime hip\n0 1\n1\n", "line 5: a row of 1 numbers; expected 2");
    fails("x\nendheader\ntime hip\n0 1 2\n", "line 4: a row of 3 numbers");
    fails("x\nendheader\ntime hip\n0 1,5\n", "column 'hip' is '1,5'");
    fails("x\nendheader\ntime hip\n0 1e999\n", "hip");
    const Skeleton skeleton = two_coordinates();
    const StorageTable nobody = read_storage("x\nendheader\ntime knee\n0 1\n", "n.mot");
    CHECK_THROWS_WITH(match_coordinates(nobody, skeleton),
                      Catch::Contains("n.mot") && Catch::Contains("hip"));
    const StorageTable twice = read_storage("x\nendheader\ntime hip hip\n0 1 2\n", "n.mot");
    CHECK_THROWS_WITH(match_coordinates(twice, skeleton), Catch::Contains("two columns"));
    const StorageTable hole = read_storage("x\ninDegrees=no\nendheader\ntime hip\n0 1\n1 nan\n", "h.mot");
    std::vector<double> q;
    CHECK_THROWS_WITH(coordinate_values(hole, match_coordinates(hole, skeleton), 1, skeleton, q),
                      Catch::Contains("h.mot, line 6") && Catch::Contains("hip"));
}
