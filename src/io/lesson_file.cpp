#include "fascicle/io/lesson_file.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/base/suggest.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/metrics/metric_table.hpp"
#include "fascicle/scene/embedded_scenes.hpp"
#include "fascicle/solver/parameters.hpp"
#include "io/built_in_resources.hpp"
#include "io/json_fields.hpp"

#include <algorithm>

namespace fascicle {

namespace {

constexpr const char* format_name = "fascicle lesson";
constexpr int newest_version = 1;

using Names = std::vector<std::string>;

/// Error when the text is none of the known ones.
void require_known(const io::JsonFields& fields, const std::string& field, const std::string& text,
                   const Names& known) {
    if (std::find(known.begin(), known.end(), text) != known.end())
        return;
    std::string all;
    for (const std::string& name : known)
        all += (all.empty() ? "" : ", ") + name;
    fields.fail(field, "got '" + text + "'" + did_you_mean(text, known), all.size() < 300 ? all : "");
}

std::string required(const io::JsonFields& fields, const char* key) {
    std::string text = fields.text(key);
    if (text.empty())
        fields.fail(key, "missing", "a text");
    return text;
}

Names strings(const io::JsonFields& fields, const char* key) {
    Names names;
    if (!fields.has(key))
        return names;
    const io::Json& list = fields.json().at(key);
    if (!list.is_array())
        fields.fail(key, "got " + list.dump().substr(0, 40), "an array of texts");
    for (const io::Json& entry : list) {
        if (!entry.is_string())
            fields.fail(key, "got " + entry.dump().substr(0, 40), "an array of texts");
        names.push_back(entry.get<std::string>());
    }
    return names;
}

/// An object as pairs, in the file's order; an array gives a pair for each entry.
std::vector<std::pair<std::string, std::string>> pairs(const io::JsonFields& fields, const char* key) {
    std::vector<std::pair<std::string, std::string>> result;
    if (!fields.has(key))
        return result;
    const io::JsonFields object = fields.object(key);
    const auto add = [&](const std::string& name, const io::Json& value) {
        if (value.is_string())
            result.emplace_back(name, value.get<std::string>());
        else if (value.is_number())
            result.emplace_back(name, number_text(value.get<double>()));
        else if (value.is_boolean())
            result.emplace_back(name, value.get<bool>() ? "on" : "off");
        else
            object.fail(name, "got " + value.dump().substr(0, 40), "a text, a number, or true or false");
    };
    for (const auto& [name, value] : object.json().items())
        if (value.is_array())
            for (const io::Json& entry : value)
                add(name, entry);
        else
            add(name, value);
    return result;
}

const Names& view_keys() {
    static const Names keys{"colouring",  "frame",      "play",        "wireframe",    "attachments",
                            "rest_ghost", "joint_axis", "side_panel",  "bottom_panel", "look",
                            "select",     "hide",       "bone_opacity"};
    return keys;
}

void set_checked(const io::JsonFields& fields, const char* field, ParamSet& parameters,
                 const std::string& key, const std::string& text) {
    try {
        if (key == "solver.method")
            set_method(parameters, text);
        else
            parameters.set_text(key, text);
    } catch (const Error& error) {
        fields.fail(field, error.what());
    }
}

LessonCheck check_of(const io::JsonFields& fields) {
    LessonCheck check;
    static const Names kinds{"parameter", "metric", "playhead", "view", "run", "fibres", "quiz"};
    for (const std::string& kind : kinds)
        if (fields.has(kind.c_str())) {
            check.what = kind;
            check.key = fields.text(kind.c_str());
        }
    if (check.what.empty())
        fields.fail("done_when", "no condition",
                    "one of parameter, metric, playhead, view, run, fibres, quiz");
    check.is = fields.text("is");
    if (fields.has("below"))
        check.below = fields.number("below", 0);
    if (fields.has("above"))
        check.above = fields.number("above", 0);
    const bool number = check.below || check.above;
    if (check.is.empty() == !number)
        fields.fail(check.what, "has nothing to compare with, or two things",
                    "\"is\", or \"below\" or \"above\"");
    const char* what = check.what.c_str();
    if (check.what == "parameter") {
        ParamSet tried = default_parameters();
        if (parameter_table().find(check.key) == nullptr)
            fields.fail(what, "no parameter '" + check.key + "'", "a key of 'fascicle parameters'");
        if (!number)
            set_checked(fields, what, tried, check.key, check.is);
    } else if (check.what == "metric") {
        if (metric_index(check.key) < 0)
            fields.fail(what, "no metric '" + check.key + "'", "a column of metrics.csv");
    } else if (check.what == "view") {
        require_known(fields, what, check.key, view_keys());
    } else {
        require_known(fields, what, check.key,
                      check.what == "playhead" ? Names{"frame", "angle_deg"}
                      : check.what == "run"    ? Names{"frames"}
                      : check.what == "fibres" ? Names{"count"}
                                               : Names{"dice"});
    }
    if (check.what == "view" ? number : check.what != "parameter" && !number)
        fields.fail(what, "compared the wrong way",
                    check.what == "view" ? "\"is\"" : "\"below\" or \"above\"");
    return check;
}

LessonStep step_of(const io::JsonFields& fields) {
    LessonStep step;
    step.title = required(fields, "title");
    step.text = required(fields, "text");
    step.task = fields.text("task");
    for (const io::JsonFields& check : fields.objects("done_when"))
        step.checks.push_back(check_of(check));
    if (step.task.empty() != step.checks.empty())
        fields.fail("task", "a task needs done_when, and done_when a task");
    ParamSet tried = default_parameters();
    step.parameters = pairs(fields, "parameters");
    for (const auto& [key, text] : step.parameters)
        set_checked(fields, "parameters", tried, key, text);
    step.view = pairs(fields, "view");
    for (const auto& [key, text] : step.view)
        require_known(fields, "view", key, view_keys());
    step.locked = strings(fields, "locked");
    step.highlighted = strings(fields, "highlighted");
    return step;
}

} // namespace

Lesson parse_lesson(std::string_view bytes, const std::string& file) {
    const io::Json json = io::parse_json_object(bytes, file);
    const io::JsonFields fields(json, file, "");
    fields.require_format(format_name, newest_version);
    Lesson lesson;
    lesson.id = fields.text("id", std::filesystem::path(file).stem().string());
    lesson.title = required(fields, "title");
    lesson.sentence = fields.text("sentence");
    lesson.minutes = fields.integer("minutes", 5);
    if (lesson.minutes < 1 || lesson.minutes > 600)
        fields.fail("minutes", "got " + std::to_string(lesson.minutes), "1 to 600");
    lesson.scene = required(fields, "scene");
    Names scenes;
    for (const EmbeddedSceneInfo& scene : embedded_scenes())
        scenes.push_back(scene.name);
    require_known(fields, "scene", lesson.scene, scenes);
    if (fields.has("quiz")) {
        const io::JsonFields quiz = fields.object("quiz");
        lesson.quiz =
            LessonQuiz{required(quiz, "muscle"), required(quiz, "bone"), quiz.text("kind", "insertion")};
        require_known(quiz, "kind", lesson.quiz->kind, {"origin", "insertion"});
    }
    for (const io::JsonFields& step : fields.objects("steps"))
        lesson.steps.push_back(step_of(step));
    if (lesson.steps.empty())
        fields.fail("steps", "none", "one step or more");
    for (const LessonStep& step : lesson.steps)
        for (const LessonCheck& check : step.checks)
            if (check.what == "quiz" && !lesson.quiz)
                fields.fail("quiz", "missing, though a step asks for its score");
    return lesson;
}

Lesson read_lesson(const std::filesystem::path& path) {
    return parse_lesson(read_file(path, std::size_t{1} << 20), path.string());
}

const std::vector<Lesson>& built_in_lessons() {
    static const std::vector<Lesson> all = [] {
        std::vector<Lesson> list;
        for (const io::BuiltInFile& file : io::built_in_lesson_files())
            list.push_back(parse_lesson(file.text, std::string(file.name)));
        return list;
    }();
    return all;
}

std::vector<LessonInfo> lessons() {
    std::vector<LessonInfo> list;
    for (const Lesson& lesson : built_in_lessons())
        list.push_back({lesson.id, lesson.title, lesson.sentence, lesson.minutes});
    return list;
}

} // namespace fascicle
