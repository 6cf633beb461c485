#pragma once
// Lessons as files: steps with text, what each sets, locks and points at, and what is to be done in it. docs/formats.md
// describes them; the editor plays them.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fascicle {

/// What must hold for a step to be done. `what` is one of
///   parameter  key's value is `is`, or below / above a number
///   metric     of any muscle, in any frame computed so far with the present parameters, below / above
///   playhead   key "frame" or "angle_deg" (its size), below / above
///   view       key of LessonStep::view, `is`
///   run        key "frames": share of the motion that is computed, above (0 to 1)
///   fibres     key "count": of all muscles together, above
///   quiz       key "dice", above
struct LessonCheck {
    std::string what, key;
    std::string is;
    std::optional<double> below, above;
};

struct LessonStep {
    std::string title, text;
    std::string task;                ///< what to do; empty: only to read
    std::vector<LessonCheck> checks; ///< all must hold at once; none: the step is done by reading it
    /// Set when the step begins, parameters as ParamSet::set_text reads them.
    std::vector<std::pair<std::string, std::string>> parameters;
    /// colouring NAME, frame N, play on|off, wireframe, attachments, rest_ghost, joint_axis on|off, side_panel ID,
    /// bottom_panel ID, look SIDE, select NAME, hide NAME (again for more; any hide replaces those before), bone_opacity 0 to 1.
    std::vector<std::pair<std::string, std::string>> view;
    /// Names of controls; a trailing * stands for the rest. What is highlighted is never locked.
    std::vector<std::string> locked, highlighted;
};

/// The question of a quiz: where does this muscle attach? Hidden truth: the area under the scene's own attachment.
struct LessonQuiz {
    std::string muscle, bone;
    std::string kind = "insertion"; ///< or origin
};

struct Lesson {
    std::string id, title;
    std::string sentence; ///< what one learns
    int minutes = 5;
    std::string scene; ///< name of an embedded scene
    std::optional<LessonQuiz> quiz;
    std::vector<LessonStep> steps; ///< one or more
};

/// From JSON. Error naming file and field: no such file, scene, parameter, value, metric or condition.
Lesson parse_lesson(std::string_view bytes, const std::string& file);
/// The same from a file of at most 1 MB.
Lesson read_lesson(const std::filesystem::path& path);
/// Those of resources/lessons, in the order in which they are offered. They are part of the program.
const std::vector<Lesson>& built_in_lessons();

/// For a list of lessons.
struct LessonInfo {
    std::string id, title, sentence;
    int minutes = 0;
};
std::vector<LessonInfo> lessons();

} // namespace fascicle
