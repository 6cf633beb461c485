#include "fascicle/base/error.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/settings_file.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;

TEST_CASE("Settings come back as they were written, beside what others wrote", "[io][settings]") {
    const test::TempDir folder;
    const auto file = folder.path() / "deep" / "settings.json";
    write_settings(file, {{"theme", std::string("light")}, {"scale", 1.25}, {"loop", true}});
    Settings read = read_settings(file);
    CHECK(std::get<std::string>(read.at("theme")) == "light");
    CHECK(std::get<double>(read.at("scale")) == 1.25);
    CHECK(std::get<bool>(read.at("loop")));

    std::string text = read_file(file);
    text.insert(text.find('{') + 1, "\n  \"later\": {\"a\": [1, null]},");
    write_file(file, text);
    write_settings(file, {{"scale", 2.0}});
    read = read_settings(file);
    CHECK(std::get<double>(read.at("scale")) == 2.0);
    CHECK(std::get<std::string>(read.at("theme")) == "light");
    CHECK(read.count("later") == 0); // of another kind
    CHECK(read_file(file).find("\"later\"") != std::string::npos);

    write_file(file, "[1, 2");
    CHECK_THROWS_AS(read_settings(file), Error);
    write_settings(file, {{"scale", 3.0}});
    CHECK(std::get<double>(read_settings(file).at("scale")) == 3.0);
    CHECK_THROWS_AS(read_settings(folder.path() / "none.json"), Error);
}

TEST_CASE("Lists of texts are read, other values are named", "[io][settings]") {
    const test::TempDir folder;
    const auto file = folder.path() / "keys.json";
    write_file(file, R"({"undo": ["Ctrl+Z", "F2"], "none": [], "bad": "Ctrl+A", "mixed": ["A", 3]})");
    std::vector<std::string> bad;
    const auto lists = read_text_lists(file, bad);
    CHECK(lists.at("undo") == std::vector<std::string>{"Ctrl+Z", "F2"});
    CHECK(lists.at("none").empty());
    CHECK(bad == std::vector<std::string>{"bad", "mixed"});
}
