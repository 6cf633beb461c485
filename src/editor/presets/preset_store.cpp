#include "editor/presets/preset_store.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/document/actions/parameter_actions.hpp"

#include <algorithm>

namespace fascicle::editor {

namespace fs = std::filesystem;

void PresetStore::read(EditorContext& context) {
    presets_ = built_in_presets();
    std::vector<std::string> problems;
    for (Preset& own : own_presets(presets_folder(context.user_folder), problems))
        presets_.push_back(std::move(own));
    for (const std::string& problem : problems)
        context.log.add(Severity::warning, problem);
    read_ = true;
}

const std::vector<Preset>& PresetStore::all(EditorContext& context) {
    if (!read_)
        read(context);
    return presets_;
}

void PresetStore::apply(EditorContext& context, const Preset& preset) {
    const std::size_t count = preset_changes(preset, context.document.scene().parameters).size();
    ParamSet parameters = context.document.scene().parameters;
    apply_preset(preset, parameters);
    actions::set_parameters(context.document, std::move(parameters), "Preset " + preset.label);
    context.log.add(Severity::note, "Preset " + preset.label + ": " +
                                        (count == 0   ? std::string("nothing to change")
                                         : count == 1 ? std::string("1 value changed")
                                                      : std::to_string(count) + " values changed") +
                                        ".");
}

std::string PresetStore::fault_of(const EditorContext& context, const std::string& name) const {
    if (context.user_folder.empty())
        return "there is no folder to keep it in";
    if (std::none_of(name.begin(), name.end(),
                     [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }))
        return "a name has a letter or a digit";
    const std::string key = preset_of(context.document.scene().parameters, name).key;
    for (const Preset& preset : built_in_presets())
        if (preset.key == key)
            return "'" + key + "' comes with the program";
    return {};
}

bool PresetStore::replaces(const std::string& name) const {
    const std::string key = preset_of(default_parameters(), name).key;
    return std::any_of(presets_.begin(), presets_.end(),
                       [&](const Preset& preset) { return !preset.file.empty() && preset.key == key; });
}

bool PresetStore::save(EditorContext& context, const std::string& name) {
    if (const std::string fault = fault_of(context, name); !fault.empty()) {
        context.log.add(Severity::error, "The preset was not kept: " + fault + ".");
        return false;
    }
    const Preset preset = preset_of(context.document.scene().parameters, name);
    try {
        write_preset(presets_folder(context.user_folder) / (preset.key + ".json"), preset);
    } catch (const Error& problem) {
        context.log.add(Severity::error, problem.what());
        return false;
    }
    read(context);
    return true;
}

void PresetStore::remove(EditorContext& context, const Preset& preset) {
    std::error_code error;
    if (preset.file.empty() || !fs::remove(preset.file, error))
        context.log.add(Severity::error, preset.label + " could not be deleted" +
                                             (error ? ": " + error.message() : std::string(".")));
    read(context);
}

} // namespace fascicle::editor
