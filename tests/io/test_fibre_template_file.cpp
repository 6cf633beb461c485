#include "fascicle/io/fibre_template_file.hpp"
#include "fascicle/io/files.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;

namespace {

const std::string good = R"({"format": "fascicle fibre template", "key": "mine", "front": [
    {"s": 0, "points": [[0, 0], [0, 1]]}, {"s": 1, "weight": 2, "points": [[1, 0], [0.5, 0.5], [1, 1]]}]})";

std::string fault(const std::string& text) {
    try {
        parse_fibre_template(text, "mine.json");
    } catch (const std::exception& error) {
        return error.what();
    }
    return "";
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const auto at = text.find(what);
    REQUIRE(at != std::string::npos);
    return text.replace(at, what.size(), by);
}

} // namespace

TEST_CASE("fibre template files: the built-in ones are those in resources, with a picture each",
          "[io][fibres]") {
    const std::filesystem::path folder =
        std::filesystem::path(FASCICLE_SOURCE_DIR) / "resources" / "fibre_templates";
    std::vector<std::string> keys;
    for (const FibreTemplate& built_in : built_in_fibre_templates()) {
        keys.push_back(built_in.key);
        const FibreTemplate from_file = read_fibre_template(folder / (built_in.key + ".json"));
        CHECK(from_file.label == built_in.label);
        CHECK_FALSE(built_in.meaning.empty());
        for (const double r : {0.0, 1.0})
            for (const double s : {0.0, 0.35, 1.0})
                for (const double t : {0.0, 0.5, 1.0}) {
                    const Vec3 p = built_in.point(r, s, t);
                    CHECK(p == from_file.point(r, s, t));
                    CHECK((p.minCoeff() >= -1e-12 && p.maxCoeff() <= 1 + 1e-12));
                }
        const PngImage kept = read_png(folder / (built_in.key + ".png"));
        const PngImage drawn = draw_fibre_template(built_in, kept.width);
        CHECK(kept.rgba == drawn.rgba);
    }
    CHECK(keys == std::vector<std::string>{"parallel", "pennate", "curved", "fanned"});
    for (const double s : {0.1, 0.6})
        CHECK((find_fibre_template("parallel").point(0.5, s, 0.3) - parallel_template().point(0.5, s, 0.3))
                  .norm() < 1e-15);
}

TEST_CASE("fibre template files: shapes of the built-in ones", "[io][fibres]") {
    const FibreTemplate pennate = find_fibre_template("pennate");
    for (const double s : {0.0, 0.5, 1.0}) { // from one side to the other
        CHECK(pennate.point(0, s, 0).x() == 0.0);
        CHECK(pennate.point(0, s, 1).x() == 1.0);
    }
    CHECK(pennate.point(0, 0, 0).y() == Approx(2.0 / 3));
    CHECK(pennate.point(0, 1, 1).y() == Approx(1.0 / 3));
    const FibreTemplate curved = find_fibre_template("curved");
    // s = 0: a cubic with weights 20: x(1/2) = 20 * 6 / (2 + 20 * 6). s = 1: straight on the side.
    CHECK(curved.point(0, 0, 0.5).x() == Approx(120.0 / 122));
    CHECK(curved.point(0, 1, 0.5).x() == Approx(0.0).margin(1e-15));
    CHECK(curved.point(0, 1, 0).y() == Approx(0.2));
    const FibreTemplate fanned = find_fibre_template("fanned");
    CHECK((fanned.point(0, 0.5, 0.5) - Vec3(0.5, 0.5 * 0.75 + 0.25, 0)).norm() < 1e-15);
    CHECK((fanned.point(0, 0.2, 1) - Vec3(0, 1, 0)).norm() < 1e-15);
    CHECK((fanned.point(0, 1, 1) - Vec3(1, 0.8, 0)).norm() < 1e-15);
}

TEST_CASE("fibre template files: a user's own, by path", "[io][fibres]") {
    const test::TempDir dir;
    write_file(dir.path() / "own.json", replaced(good, "\"key\": \"mine\", ", ""));
    const FibreTemplate own = find_fibre_template((dir.path() / "own.json").string());
    CHECK(own.key == "own");
    CHECK(own.label == "own");
    CHECK(own.front[1].weight == 2.0);
    CHECK(own.front[0].weight == 1.0);
    CHECK_THROWS_WITH(find_fibre_template((dir.path() / "other.json").string()),
                      Catch::Contains("other.json") && Catch::Contains("parallel, pennate"));
    CHECK_THROWS_WITH(find_fibre_template("fan"), Catch::Contains("'fan'") && Catch::Contains("fanned"));
}

TEST_CASE("fibre template files: faults are named with file and field", "[io][fibres]") {
    CHECK(fault(good).empty());
    CHECK_THAT(fault(""), Catch::StartsWith("mine.json"));
    CHECK_THAT(fault("[1, 2]"), Catch::Contains("no JSON object"));
    CHECK_THAT(fault(good.substr(0, good.size() - 3)), Catch::Contains("mine.json, line"));
    CHECK_THAT(fault(replaced(good, "fascicle fibre template", "other")),
               Catch::Contains("field format") && Catch::Contains("'other'"));
    CHECK_THAT(fault(R"({"front": []})"), Catch::Contains("field format: missing"));
    CHECK_THAT(fault(replaced(good, "\"key\"", "\"version\": 2, \"key\"")), Catch::Contains("version"));
    CHECK_THAT(fault(replaced(good, "[0.5, 0.5]", "[0.5]")),
               Catch::Contains("front[1].points[1]") && Catch::Contains("[x, y]"));
    CHECK_THAT(fault(replaced(good, "[0.5, 0.5]", "\"a\"")), Catch::Contains("front[1].points[1]"));
    CHECK_THAT(fault(replaced(good, "[0.5, 0.5]", "[0.5, 7]")),
               Catch::Contains("0.5") && Catch::Contains("7.0"));
    CHECK_THAT(fault(replaced(good, "[0.5, 0.5]", "[0.5, 1e999]")), !Catch::Equals(""));
    CHECK_THAT(fault(replaced(good, "\"weight\": 2", "\"weight\": -2")), Catch::Contains("weight is -2"));
    CHECK_THAT(fault(replaced(good, "\"weight\": 2", "\"weight\": \"2\"")),
               Catch::Contains("front[1].weight"));
    CHECK_THAT(fault(replaced(good, "\"s\": 1, ", "")), Catch::Contains("front[1].s: missing"));
    CHECK_THAT(fault(replaced(good, "\"s\": 1", "\"s\": 0.5")), Catch::Contains("rising from 0 to 1"));
    CHECK_THAT(fault(R"({"format": "fascicle fibre template"})"), Catch::Contains("0 polygons"));
}

TEST_CASE("fibre template pictures are transparent outside and drawn inside at any size", "[io][fibres]") {
    for (const int size : {16, 96, 300}) {
        const PngImage image = draw_fibre_template(parallel_template(), size);
        REQUIRE(image.rgba.size() == 4 * static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
        CHECK(image.rgba[3] == 0);
        std::size_t drawn = 0;
        for (std::size_t i = 3; i < image.rgba.size(); i += 4)
            drawn += image.rgba[i] > 0 ? 1u : 0u;
        CHECK(drawn > image.rgba.size() / 4 / 10);
        CHECK(drawn < image.rgba.size() / 4);
    }
}
