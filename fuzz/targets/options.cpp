// Texts of options, and files that name parameters.

#include "fascicle/io/lesson_file.hpp"
#include "fascicle/io/load_scene.hpp"
#include "fascicle/io/osim_request.hpp"
#include "fascicle/io/preset_file.hpp"
#include "fascicle/solver/parameters.hpp"
#include "fuzz/check.hpp"
#include "fuzz/targets.hpp"
#include "fuzz/words.hpp"
#include "io/formats/text_scanner.hpp"

#include <cmath>

namespace fascicle::fuzz {
namespace {

void fuzz_options(std::string_view bytes) {
    const std::string text(bytes);
    check_usage([&] {
        const HingeRequest hinge = parse_hinge(text);
        FUZZ_CHECK(std::abs(hinge.axis.norm() - 1) < 1e-9);
        FUZZ_CHECK(!hinge.centre || hinge.centre->allFinite());
    });
    check_usage([&] {
        const Phases phases = parse_phases(text);
        FUZZ_CHECK(phases.out >= 0 && phases.back >= 0 && phases.rest >= 0 && phases.total() > 0);
    });
    check_usage([&] { parse_unit(text); });
    check_usage([&] {
        const auto [name, file] = parse_named_file("--attachments", text);
        FUZZ_CHECK(!name.empty() && !file.empty());
    });
    check_usage([&] { parse_mesh_frame(text); });
    check_usage([&] { FUZZ_CHECK(*axis_mapping_key(parse_axis_mapping(text)) != 0); });
    check_usage([&] { FUZZ_CHECK(!parse_mesh_of_bodies("--muscle", text).mesh.empty()); });
    double number = 0;
    if (parse_number(text, number)) {
        double back = 0;
        FUZZ_CHECK(std::isfinite(number) && parse_number(number_text(number), back) && back == number);
    }
    if (io::to_double(text, number) == io::NumberCheck::ok && std::isfinite(number)) {
        double back = 0;
        FUZZ_CHECK(io::to_double(number_text(number), back) == io::NumberCheck::ok && back == number);
    }
    long long whole = 0;
    if (io::to_integer(text, whole) == io::NumberCheck::ok) {
        long long back = 0;
        FUZZ_CHECK(io::to_integer(std::to_string(whole), back) == io::NumberCheck::ok && back == whole);
    }
}

/// A KEY=VALUE a line, as --set takes them.
void fuzz_parameters(std::string_view bytes) {
    static const ParamSet defaults = default_parameters();
    ParamSet parameters = defaults;
    for (const std::string& word : words_of(bytes))
        check_usage([&] {
            const std::string method = "solver.method=";
            if (word.starts_with(method))
                set_method(parameters, word.substr(method.size()));
            else
                parameters.assign(word);
        });
    ParamSet again = defaults;
    set_method(again, parameters.get_choice("solver.method"));
    for (const ParamRow& row : parameters.table().rows()) {
        const double value = parameters.get(row.key);
        FUZZ_CHECK(value >= row.minimum && value <= row.maximum);
        if (parameters.edited(row.key))
            again.set_text(row.key, parameters.text(row.key));
    }
    FUZZ_CHECK(again == parameters);
}

void fuzz_preset(std::string_view bytes) {
    Preset read;
    if (!reads("fuzz.json", [&] { read = parse_preset(bytes, "fuzz.json"); }))
        return;
    static const ParamSet defaults = default_parameters();
    FUZZ_CHECK(!read.key.empty() && !read.values.empty());
    ParamSet applied = defaults;
    apply_preset(read, applied);
    preset_changes(read, defaults);
    const Preset back = parse_preset(preset_text(read), "written.json");
    FUZZ_CHECK(back.key == read.key && back.label == read.label && back.meaning == read.meaning);
    ParamSet again = defaults;
    apply_preset(back, again);
    FUZZ_CHECK(again == applied);
}

void fuzz_lesson(std::string_view bytes) {
    reads("fuzz.json", [&] {
        const Lesson lesson = parse_lesson(bytes, "fuzz.json");
        FUZZ_CHECK(!lesson.title.empty() && !lesson.steps.empty() && lesson.minutes >= 1);
        for (const LessonStep& step : lesson.steps)
            FUZZ_CHECK(!step.title.empty() && step.task.empty() == step.checks.empty());
    });
}

} // namespace

std::vector<Target> option_targets() {
    return {
        {"preset", fuzz_preset, 2 * kB, "preset", "preset", 400, MB},
        {"lesson", fuzz_lesson, 4 * kB, "lesson", "lesson", 400, MB},
        {"options", fuzz_options, 128, "options", "options", 1000, MB},
        {"parameters", fuzz_parameters, 256, "parameters", "parameters", 1000, MB},
    };
}

} // namespace fascicle::fuzz
