#include "editor/settings.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/io/files.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace fascicle::editor {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

constexpr std::size_t most_bytes = 1 << 20;

/// The settings in force over what the file had.
std::string settings_text(const EditorState& state, const std::string& previous) {
    Json json = Json::parse(previous, nullptr, false);
    if (!json.is_object())
        json = Json::object();
    json["theme"] = state.dark ? "dark" : "light";
    json["scale"] = state.scale == state.start_scale ? Json(nullptr) : Json(state.scale);
    json["mouse"] = navigations[static_cast<std::size_t>(state.navigation)].key;
    const LayoutSizes& sizes = state.layout;
    json["layout"] = {{"left", sizes.left},
                      {"right", sizes.right},
                      {"bottom", sizes.bottom},
                      {"tree_share", sizes.tree_share},
                      {"show_left", sizes.show_left},
                      {"show_right", sizes.show_right},
                      {"show_bottom", sizes.show_bottom}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

template <typename Value>
void take(const Json& json, const char* key, Value& value) {
    const auto it = json.find(key);
    if (it == json.end())
        return;
    if constexpr (std::is_same_v<Value, bool>) {
        if (it->is_boolean())
            value = it->get<bool>();
    } else if (it->is_number()) {
        value = it->get<Value>();
    }
}

void apply(const Json& json, EditorState& state) {
    if (const auto it = json.find("theme"); it != json.end() && it->is_string())
        state.dark = *it != "light";
    if (const auto it = json.find("scale"); it != json.end() && it->is_number())
        state.scale = std::clamp(it->get<float>(), 0.75f, 3.0f);
    if (const auto it = json.find("mouse"); it != json.end() && it->is_string())
        for (const NavigationRow& row : navigations)
            if (*it == row.key)
                state.navigation = row.navigation;
    const auto layout = json.find("layout");
    if (layout == json.end() || !layout->is_object())
        return;
    LayoutSizes& sizes = state.layout; // compute_layout() keeps them within its limits
    take(*layout, "left", sizes.left);
    take(*layout, "right", sizes.right);
    take(*layout, "bottom", sizes.bottom);
    take(*layout, "tree_share", sizes.tree_share);
    take(*layout, "show_left", sizes.show_left);
    take(*layout, "show_right", sizes.show_right);
    take(*layout, "show_bottom", sizes.show_bottom);
}

/// { "command-id": ["Ctrl+Shift+P", ...], ... }
void apply_keys(const Json& json, const std::string& file, MessageLog& log) {
    for (const auto& [id, value] : json.items()) {
        std::vector<KeyChord> chords;
        bool good = value.is_array() && value.size() <= 2;
        for (std::size_t i = 0; good && i < value.size(); ++i) {
            const std::optional<KeyChord> chord =
                value[i].is_string() ? parse_chord(value[i].get<std::string>()) : std::nullopt;
            good = chord.has_value();
            if (good)
                chords.push_back(*chord);
        }
        if (!good)
            log.add(Severity::warning,
                    file + ": '" + id + "' has no list of at most two keys such as \"Ctrl+P\"");
        else if (const std::string problem = set_user_keys(id, chords); !problem.empty())
            log.add(Severity::warning, file + ": " + problem);
    }
}

} // namespace

Settings::~Settings() {
    save();
}

void Settings::load(EditorContext& context) {
    reset_user_keys();
    folder_ = context.user_folder;
    if (folder_.empty())
        return;
    const auto read = [&](const char* name, auto use) {
        const fs::path file = folder_ / name;
        std::error_code code;
        if (!fs::exists(file, code))
            return;
        try {
            const std::string text = read_file(file, most_bytes);
            const Json json = Json::parse(text, nullptr, false);
            if (!json.is_object())
                throw_error(file.string(), "is no JSON object; the defaults are used");
            use(json, text, file.string());
        } catch (const std::exception& problem) {
            context.log.add(Severity::warning, problem.what());
        }
    };
    read("settings.json", [&](const Json& json, const std::string& text, const std::string&) {
        apply(json, context.state);
        saved_ = text;
    });
    read("keys.json", [&](const Json& json, const std::string&, const std::string& file) {
        apply_keys(json, file, context.log);
    });
    text_ = saved_ = settings_text(context.state, saved_);
}

void Settings::update(EditorContext& context) {
    if (!loaded_) {
        loaded_ = true;
        load(context);
    }
    if (folder_.empty() || (ImGui::IsMouseDown(0) && text_ == saved_))
        return; // borders are being dragged
    if (std::string now = settings_text(context.state, saved_); now != text_) {
        text_ = std::move(now);
        changed_ = context.now;
    }
    if (text_ != saved_ && context.now - changed_ >= settle_seconds)
        save();
}

void Settings::save() {
    if (folder_.empty() || text_ == saved_)
        return;
    saved_ = text_;
    try {
        write_file(folder_ / "settings.json", text_);
    } catch (const std::exception&) {
        // A full disk must not get in the way of work; the settings of this session simply do not stay.
    }
}

std::optional<double> Settings::redraw_after() const {
    return text_ == saved_ ? std::nullopt : std::optional<double>(settle_seconds / 2);
}

} // namespace fascicle::editor
