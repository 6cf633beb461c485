#include "editor/settings.hpp"

#include <algorithm>

namespace fascicle::editor {

namespace fs = std::filesystem;

namespace {

/// Where each value lives.
struct Place {
    const char* key;
    float LayoutSizes::*size = nullptr;
    bool LayoutSizes::*shown = nullptr;
};

constexpr Place places[] = {
    {"layout.left", &LayoutSizes::left, nullptr},
    {"layout.right", &LayoutSizes::right, nullptr},
    {"layout.bottom", &LayoutSizes::bottom, nullptr},
    {"layout.tree_share", &LayoutSizes::tree_share, nullptr},
    {"layout.show_left", nullptr, &LayoutSizes::show_left},
    {"layout.show_right", nullptr, &LayoutSizes::show_right},
    {"layout.show_bottom", nullptr, &LayoutSizes::show_bottom},
};

fascicle::Settings settings_of(const EditorState& state) {
    fascicle::Settings settings;
    settings["theme"] = std::string(state.dark ? "dark" : "light");
    // Times the monitor's: a file that moves to another screen still fits.
    const float scale = state.presenting ? 1.0f : state.scale / state.start_scale;
    settings["scale"] = std::round(double(scale) * 100) / 100;
    settings["mouse"] = std::string(navigations[static_cast<std::size_t>(state.navigation)].key);
    for (const Place& place : places)
        if (place.size != nullptr)
            settings[place.key] = double(state.layout.*place.size);
        else
            settings[place.key] = state.layout.*place.shown;
    return settings;
}

template <typename Value>
const Value* find(const fascicle::Settings& settings, const char* key) {
    const auto it = settings.find(key);
    return it == settings.end() ? nullptr : std::get_if<Value>(&it->second);
}

void take_over(const fascicle::Settings& settings, EditorState& state) {
    if (const auto* theme = find<std::string>(settings, "theme"))
        state.dark = *theme != "light";
    if (const auto* scale = find<double>(settings, "scale"))
        state.scale = std::clamp(static_cast<float>(*scale) * state.start_scale, 0.75f, 3.0f);
    if (const auto* mouse = find<std::string>(settings, "mouse"))
        for (const NavigationRow& row : navigations)
            if (*mouse == row.key)
                state.navigation = row.navigation;
    for (const Place& place : places) { // compute_layout() keeps sizes within its limits
        if (const auto* size = find<double>(settings, place.key); size != nullptr && place.size != nullptr)
            state.layout.*place.size = static_cast<float>(std::clamp(*size, 0.0, 10000.0));
        if (const auto* shown = find<bool>(settings, place.key); shown != nullptr && place.shown != nullptr)
            state.layout.*place.shown = *shown;
    }
}

void apply_keys(const fs::path& file, MessageLog& log) {
    std::vector<std::string> bad;
    auto lists = read_text_lists(file, bad);
    for (const std::string& id : bad)
        lists.erase(id);
    const auto complain = [&](const std::string& what) {
        log.add(Severity::warning, file.string() + ": " + what);
    };
    for (const std::string& id : bad)
        complain("'" + id + "' has no list of keys such as [\"Ctrl+P\"]");
    for (const auto& [id, texts] : lists) {
        std::vector<KeyChord> chords;
        std::string problem = texts.size() > 2 ? "'" + id + "' has more than two keys" : "";
        for (const std::string& text : texts)
            if (const std::optional<KeyChord> chord = parse_chord(text))
                chords.push_back(*chord);
            else if (problem.empty())
                problem = "'" + text + "' of '" + id + "' is no key; keys look like Ctrl+Shift+P";
        if (problem.empty())
            problem = set_user_keys(id, chords);
        if (!problem.empty())
            complain(problem);
    }
}

} // namespace

SettingsKeeper::~SettingsKeeper() {
    save();
}

void SettingsKeeper::load(EditorContext& context) {
    reset_user_keys();
    if (context.user_folder.empty())
        return;
    file_ = context.user_folder / "settings.json";
    const fs::path keys = context.user_folder / "keys.json";
    std::error_code code;
    try {
        if (fs::exists(file_, code))
            take_over(read_settings(file_), context.state);
    } catch (const std::exception& problem) {
        context.log.add(Severity::warning, problem.what());
    }
    try {
        if (fs::exists(keys, code))
            apply_keys(keys, context.log);
    } catch (const std::exception& problem) {
        context.log.add(Severity::warning, problem.what());
    }
    now_ = saved_ = settings_of(context.state);
}

void SettingsKeeper::update(EditorContext& context) {
    if (!loaded_) {
        loaded_ = true;
        load(context);
    }
    if (file_.empty())
        return;
    if (fascicle::Settings now = settings_of(context.state); now != now_) {
        now_ = std::move(now);
        changed_ = context.now;
    }
    if (now_ != saved_ && context.now - changed_ >= settle_seconds)
        save();
}

void SettingsKeeper::save() {
    if (file_.empty() || now_ == saved_)
        return;
    saved_ = now_;
    try {
        write_settings(file_, now_);
    } catch (const std::exception&) {
        // A full disk must not get in the way of work; the settings of this session simply do not stay.
    }
}

std::optional<double> SettingsKeeper::redraw_after() const {
    return now_ == saved_ ? std::nullopt : std::optional<double>(settle_seconds / 2);
}

} // namespace fascicle::editor
