#include "fascicle/base/error.hpp"
#include "fascicle/io/lesson_file.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;

namespace {

std::string file_with(const std::string& step, const std::string& more = {}) {
    return "{\"format\": \"fascicle lesson\", \"version\": 1, \"title\": \"T\", \"scene\": \"squish-box\"" +
           more + ", \"steps\": [{\"title\": \"S\", \"text\": \"Words\"" + step + "}]}";
}

std::string problem_of(const std::string& text) {
    try {
        parse_lesson(text, "mine.json");
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

} // namespace

TEST_CASE("A lesson file is read with all that a step may say", "[io][lessons]") {
    const Lesson lesson = parse_lesson(
        file_with(
            R"(, "task": "Do", "done_when": [{"parameter": "solver.bending", "below": 0.5}, {"view": "colouring", "is": "depth"}],
            "parameters": {"solver.bending": 0.7, "solver.volume": "free"},
            "view": {"hide": ["a", "b"], "wireframe": true, "frame": 7}, "locked": ["parameter/*"], "highlighted": ["x"])",
            R"(, "quiz": {"muscle": "m", "bone": "b"}, "minutes": 3)"),
        "mine.json");
    CHECK(lesson.id == "mine");
    CHECK(lesson.minutes == 3);
    REQUIRE(lesson.quiz);
    CHECK(lesson.quiz->kind == "insertion");
    const LessonStep& step = lesson.steps.at(0);
    REQUIRE(step.checks.size() == 2);
    CHECK(step.checks[0].what == "parameter");
    CHECK(step.checks[0].below == 0.5);
    CHECK(step.checks[1].is == "depth");
    CHECK(step.parameters.at(1).second == "free");
    using Pairs = std::vector<std::pair<std::string, std::string>>;
    CHECK(step.view == Pairs{{"hide", "a"}, {"hide", "b"}, {"wireframe", "on"}, {"frame", "7"}});
    CHECK(step.locked == std::vector<std::string>{"parameter/*"});
}

TEST_CASE("Bad lesson files name the file and what is wrong", "[io][lessons]") {
    CHECK(problem_of(file_with("")).empty());
    const auto complains = [](const std::string& text, const char* word) {
        INFO(text);
        INFO(problem_of(text));
        CHECK(problem_of(text).find(word) != std::string::npos);
        CHECK(problem_of(text).find("mine.json") != std::string::npos);
        CHECK(problem_of(text).find('\n') == std::string::npos);
    };
    complains("[]", "mine.json");
    complains("{\"format\": \"fascicle preset\"}", "format");
    complains("{\"format\": \"fascicle lesson\", \"title\": \"T\", \"scene\": \"squish-box\"}", "steps");
    complains("{\"format\": \"fascicle lesson\", \"title\": \"T\", \"scene\": \"squishbox\", \"steps\": []}",
              "did you mean 'squish-box'");
    complains(file_with("", ", \"minutes\": 0"), "minutes");
    complains(file_with("", ", \"quiz\": {\"muscle\": \"m\"}"), "bone");
    complains(file_with(", \"task\": \"Do\""), "done_when");
    complains(file_with(", \"parameters\": {\"solver.nope\": 1}"), "solver.nope");
    complains(file_with(", \"parameters\": {\"solver.bending\": 9}"), "solver.bending");
    complains(file_with(", \"view\": {\"colour\": \"depth\"}"), "colouring");
    complains(file_with(", \"locked\": \"parameter/*\""), "locked");
    const auto check = [](const std::string& condition) {
        return file_with(", \"task\": \"Do\", \"done_when\": [{" + condition + "}]");
    };
    complains(check("\"metric\": \"volume\", \"below\": 1"), "volume");
    complains(check("\"metric\": \"volume_ratio\""), "compare");
    complains(check("\"metric\": \"volume_ratio\", \"is\": \"small\""), "compared");
    complains(check("\"view\": \"colouring\", \"above\": 1"), "compared");
    complains(check("\"parameter\": \"solver.method\", \"is\": \"magic\""), "magic");
    complains(check("\"playhead\": \"time\", \"above\": 1"), "angle_deg");
    complains(check("\"quiz\": \"dice\", \"above\": 0.5"), "quiz");
    complains(check("\"above\": 0.5"), "condition");
}
