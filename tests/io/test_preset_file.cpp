#include "fascicle/base/error.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/preset_file.hpp"
#include "fascicle/solver/parameters.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;

namespace {

ParamSet with(const char* preset) {
    ParamSet parameters = default_parameters();
    apply_preset(find_preset(preset, {}), parameters);
    return parameters;
}

std::string problem_of(const std::string& text) {
    try {
        parse_preset(text, "mine.json");
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

} // namespace

TEST_CASE("Built-in presets: paper is classic with its own defaults, the others are what they are called",
          "[io][presets]") {
    REQUIRE(built_in_presets().size() == 4);
    ParamSet classic = default_parameters();
    set_method(classic, "classic");
    const ParamSet paper = with("paper");
    for (const char* key : {"solver.method", "solver.stiffness", "solver.bending", "solver.damping",
                            "solver.pressure", "solver.anisotropy", "solver.volume", "classic.equations"})
        CHECK(paper.get(key) == Approx(classic.get(key)));
    CHECK(passes_per_frame(paper) == 3);
    CHECK(with("soft").get("solver.stiffness") < default_parameters().get("solver.stiffness"));
    CHECK(with("stiff").get("solver.stiffness") > default_parameters().get("solver.stiffness"));
    CHECK(with("isotropic").get("solver.anisotropy") == 0);
    for (const Preset& preset : built_in_presets())
        CHECK_FALSE(preset.meaning.empty());
    // From one to another nothing of the first remains.
    ParamSet both = with("paper");
    apply_preset(find_preset("soft", {}), both);
    CHECK(both.get_choice("solver.method") == "xpbd");
    CHECK(both.get("solver.damping") == with("soft").get("solver.damping"));
}

TEST_CASE("A preset written is the preset read", "[io][presets]") {
    const test::TempDir folder;
    ParamSet parameters = default_parameters();
    set_method(parameters, "classic");
    parameters.set("solver.damping", 1.0 / 3);
    parameters.set_text("fibres.template", "fanned");
    const Preset preset = preset_of(parameters, "My own");
    CHECK(preset.key == "my-own");
    const auto file = presets_folder(folder.path()) / "my-own.json";
    write_preset(file, preset);
    std::vector<std::string> problems;
    const std::vector<Preset> own = own_presets(presets_folder(folder.path()), problems);
    REQUIRE(own.size() == 1);
    CHECK(problems.empty());
    CHECK(own[0].label == "My own");
    CHECK(own[0].values == preset.values);
    ParamSet again = default_parameters();
    apply_preset(find_preset("my-own", presets_folder(folder.path())), again);
    CHECK(again == parameters);
    ParamSet by_path = default_parameters();
    apply_preset(find_preset(file.string(), {}), by_path);
    CHECK(by_path == parameters);
    CHECK(preset_changes(preset, parameters).empty());
    CHECK(preset_changes(preset, default_parameters()).size() >= 3);
    CHECK(own_presets({}, problems).empty());
    CHECK(own_presets(folder.path() / "none", problems).empty());
}

TEST_CASE("Bad presets name the file and what is wrong", "[io][presets]") {
    CHECK(problem_of("nonsense").find("mine.json") != std::string::npos);
    CHECK(problem_of("{}").find("format") != std::string::npos);
    const std::string head = "{\"format\": \"fascicle preset\", ";
    CHECK(problem_of(head + "\"version\": 9, \"values\": {\"solver.bending\": 1}}").find("version") !=
          std::string::npos);
    CHECK(problem_of(head + "\"values\": {}}").find("values") != std::string::npos);
    CHECK(problem_of(head + "\"key\": \"a\"}").find("values") != std::string::npos);
    CHECK(problem_of(head + "\"values\": {\"solver.bending\": 7}}").find("solver.bending") !=
          std::string::npos);
    CHECK(problem_of(head + "\"values\": {\"solver.bending\": [1]}}").find("solver.bending") !=
          std::string::npos);
    CHECK(problem_of(head + "\"values\": {\"solver.method\": \"magic\"}}").find("solver.method") !=
          std::string::npos);
    CHECK(problem_of(head + "\"values\": {\"solver.bending\": 0.5}}").empty());
    CHECK_THROWS_WITH(find_preset("papper", {}), Catch::Contains("did you mean 'paper'"));
}
