#include "fascicle/io/fibre_files.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/io/csv.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "support/fibres.hpp"
#include "support/temp_dir.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace fascicle;
using namespace fascicle::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

FibreSet fibres_at(double angle, double shift = 0.0) {
    return straight_fibres({{Vec3(shift, 0, 0), Vec3(shift + 100 - 10 * angle, 0, 0)},
                            {Vec3(0, shift, 0), Vec3(0, shift, 50 + 20 * angle)}},
                           3);
}

FibreSeries series_of(const std::string& muscle, double angle_step, double shift = 0.0) {
    FibreSeries series(muscle, 1.0, 1.0);
    for (int k = 0; k <= 4; ++k)
        series.append(k, angle_step * k, fibres_at(angle_step * k, shift));
    return series;
}

const NamedArray* find(const std::vector<NamedArray>& arrays, const std::string& name) {
    const auto found =
        std::find_if(arrays.begin(), arrays.end(), [&](const NamedArray& a) { return a.name == name; });
    return found == arrays.end() ? nullptr : &*found;
}

} // namespace

TEST_CASE("fibres.csv has a row per frame, muscle and fibre", "[io][fibre]") {
    const TempDir dir;
    const FibreSeries a = series_of("psoas", 0.1), b = series_of("iliacus, left", 0.1, 1.0);
    write_fibre_table(dir.path() / "fibres.csv", {&a, &b});
    const std::string bytes = read_file(dir.path() / "fibres.csv");
    CHECK(bytes.substr(0, bytes.find('\n')) == "frame,muscle,fibre,angle_deg,length_mm,strain,moment_arm_mm,"
                                               "pennation_origin_deg,pennation_insertion_deg");
    CsvReader csv(bytes, "fibres.csv");
    int rows = 0;
    while (csv.next_row()) {
        const int k = rows / 4, m = rows / 2 % 2, f = rows % 2;
        const FibreSeries& s = m == 0 ? a : b;
        CHECK(csv.number(csv.column("frame")) == k);
        CHECK(csv.cell(csv.column("muscle")) == s.muscle());
        CHECK(csv.number(csv.column("fibre")) == f);
        CHECK(csv.number(csv.column("angle_deg")) == Approx(0.1 * k * 180.0 / std::numbers::pi));
        for (const FibreQuantityRow& row : fibre_quantities()) // to the last bit
            CHECK(csv.number(csv.column(row.key)) == s.value(row.quantity, k, f));
        ++rows;
    }
    CHECK(rows == 20);
}

TEST_CASE("fibres.csv without motion or without fibres", "[io][fibre]") {
    const TempDir dir;
    const FibreSeries still = series_of("psoas", 0.0);
    write_fibre_table(dir.path() / "a.csv", {&still});
    CHECK_THAT(read_file(dir.path() / "a.csv"), Contains("0,psoas,0,0,100,0,nan,"));
    write_fibre_table(dir.path() / "b.csv", {});
    const std::string header = read_file(dir.path() / "b.csv");
    CHECK(std::count(header.begin(), header.end(), '\n') == 1);
    write_file(dir.path() / "plain", "x");
    CHECK_THROWS_WITH(write_fibre_table(dir.path() / "plain" / "fibres.csv", {&still}), Contains("plain"));
    for (const auto& entry : fs::directory_iterator(dir.path()))
        CHECK(entry.path().string().find(".part") == std::string::npos);
}

TEST_CASE("polylines of a frame come back with their arrays", "[io][fibre]") {
    const TempDir dir;
    const FibreSeries series = series_of("psoas", 0.1);
    const FibreSet fibres = fibres_at(0.3);
    const fs::path path = dir.path() / fibre_file("psoas", 3);
    CHECK(fibre_file("psoas", 3) == fs::path("fibres/psoas.0003.vtp"));
    CHECK(fibre_file("a/b", 12345) == fs::path("fibres/a_b.12345.vtp"));
    write_mesh_file(path, fibre_lines(series, 3, fibres));
    const MeshFile read = read_mesh_file(path);
    CHECK(read.lines.points == fibres.points);
    CHECK(read.lines.lines == std::vector<std::vector<int>>{{0, 1, 2, 3}, {4, 5, 6, 7}});
    REQUIRE(read.line_arrays.size() == 6);
    CHECK(read.line_arrays[0].name == "fibre_id");
    CHECK(read.line_arrays[0].values == std::vector<double>{0, 1});
    for (const FibreQuantityRow& row : fibre_quantities()) {
        const NamedArray* array = find(read.line_arrays, row.key);
        REQUIRE(array != nullptr);
        CHECK(array->values == series.values(row.quantity, 3));
    }
    const NamedArray* stretch = find(read.point_arrays, "stretch");
    REQUIRE(stretch != nullptr);
    REQUIRE(stretch->values.size() == 8);
    CHECK(stretch->values[2] == Approx(0.97));
    CHECK(stretch->values[5] == Approx(56.0 / 50.0));
    const NamedArray* tangent = find(read.point_arrays, "tangent");
    REQUIRE(tangent != nullptr);
    CHECK(tangent->components == 3);
    CHECK(tangent->values[6] == Approx(1.0));  // x of point 2
    CHECK(tangent->values[17] == Approx(1.0)); // z of point 5
}

TEST_CASE("arrays that are not defined everywhere are left out of the polylines", "[io][fibre]") {
    const FibreSeries still = series_of("psoas", 0.0);
    const MeshData data = fibre_lines(still, 2, fibres_at(0.0));
    CHECK(find(data.line_arrays, "moment_arm_mm") == nullptr);
    CHECK(find(data.line_arrays, "length_mm") != nullptr);
    CHECK(find(data.line_arrays, "strain") != nullptr);
    // Fibres of a scene in metres, at rest, without a run.
    const MeshData plain = fibre_lines(straight_fibres({{Vec3(0, 0, 0), Vec3(0, 0, 0.2)}}, 2), 1000.0);
    REQUIRE(find(plain.line_arrays, "length_mm") != nullptr);
    CHECK(find(plain.line_arrays, "length_mm")->values[0] == Approx(200.0));
    CHECK(plain.lines.points[2] == Vec3(0, 0, 0.2));
    CHECK(find(plain.point_arrays, "stretch") == nullptr);
    CHECK(fibre_lines(FibreSet{}, 1.0).lines.lines.empty());
}
