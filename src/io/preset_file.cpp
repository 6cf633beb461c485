#include "fascicle/io/preset_file.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/base/suggest.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/solver/parameters.hpp"
#include "io/built_in_resources.hpp"
#include "io/json_fields.hpp"

#include <algorithm>
#include <cstdio>

namespace fascicle {

namespace fs = std::filesystem;

namespace {

constexpr const char* format_name = "fascicle preset";
constexpr int newest_version = 1;
constexpr std::size_t most_bytes = std::size_t{1} << 20;

std::string short_value(const ParamRow& row, double value) {
    if (row.kind == ParamKind::choice)
        return row.choices[static_cast<std::size_t>(value)];
    char text[40];
    std::snprintf(text, sizeof text, "%.4g", value);
    std::string result = text;
    if (row.unit != "1")
        result.append(" ").append(row.unit);
    return result;
}

} // namespace

Preset parse_preset(std::string_view bytes, const std::string& file) {
    const io::Json json = io::parse_json_object(bytes, file);
    const io::JsonFields fields(json, file, "");
    fields.require_format(format_name, newest_version);
    Preset preset;
    preset.key = fields.text("key", fs::path(file).stem().string());
    if (preset.key.empty())
        fields.fail("key", "empty", "a short name");
    preset.label = fields.text("label", preset.key);
    preset.meaning = fields.text("meaning");
    const io::JsonFields values = fields.object("values");
    ParamSet checked = default_parameters();
    for (const auto& [key, value] : values.json().items()) {
        if (!value.is_string() && !value.is_number())
            values.fail(key, "got " + value.dump().substr(0, 40), "a number or the name of a choice");
        const std::string text =
            value.is_string() ? value.get<std::string>() : number_text(value.get<double>());
        try {
            checked.set_text(key, text);
        } catch (const Error& error) {
            throw_error(file, error.what());
        }
        preset.values.emplace_back(key, text);
    }
    if (preset.values.empty())
        fields.fail("values", "empty", "one parameter or more");
    return preset;
}

Preset read_preset(const fs::path& path) {
    Preset preset = parse_preset(read_file(path, most_bytes), path.string());
    preset.file = path;
    return preset;
}

void write_preset(const fs::path& path, const Preset& preset) {
    write_file(path, preset_text(preset));
}

std::string preset_text(const Preset& preset) {
    io::Json json;
    json["format"] = format_name;
    json["version"] = newest_version;
    json["key"] = preset.key;
    json["label"] = preset.label;
    json["meaning"] = preset.meaning;
    io::Json& values = json["values"] = io::Json::object();
    for (const auto& [key, text] : preset.values) {
        double number = 0;
        const ParamRow* row = parameter_table().find(key);
        if (row != nullptr && row->kind != ParamKind::choice && parse_number(text, number))
            values[key] = number;
        else
            values[key] = text;
    }
    // A key may be a file's name, which need not be UTF-8.
    return json.dump(2, ' ', false, io::Json::error_handler_t::replace) + "\n";
}

const std::vector<Preset>& built_in_presets() {
    static const std::vector<Preset> presets = [] {
        std::vector<Preset> all;
        for (const io::BuiltInFile& file : io::built_in_preset_files())
            all.push_back(parse_preset(file.text, std::string(file.name)));
        return all;
    }();
    return presets;
}

fs::path presets_folder(const fs::path& user_folder) {
    return user_folder.empty() ? fs::path() : user_folder / "presets";
}

std::vector<Preset> own_presets(const fs::path& folder, std::vector<std::string>& problems) {
    std::vector<Preset> presets;
    std::error_code error;
    std::vector<fs::path> files;
    if (!folder.empty())
        for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
            if (it->path().extension() == ".json")
                files.push_back(it->path());
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files) {
        try {
            presets.push_back(read_preset(file));
        } catch (const Error& problem) {
            problems.emplace_back(problem.what());
        }
    }
    return presets;
}

Preset find_preset(const std::string& key_or_path, const fs::path& folder) {
    std::vector<std::string> problems, keys;
    std::vector<Preset> all = built_in_presets();
    for (Preset& own : own_presets(folder, problems))
        all.push_back(std::move(own));
    for (const Preset& preset : all) {
        if (preset.key == key_or_path)
            return preset;
        keys.push_back(preset.key);
    }
    std::error_code ignored;
    if (fs::exists(key_or_path, ignored))
        return read_preset(key_or_path);
    std::string known;
    for (const std::string& key : keys)
        known += key + ", ";
    throw_error("preset '" + key_or_path + "'",
                "neither built in, nor your own, nor a file" + did_you_mean(key_or_path, keys),
                known + "or the path of a preset file", ErrorKind::usage);
}

Preset preset_of(const ParamSet& parameters, const std::string& label) {
    Preset preset;
    preset.label = label;
    for (const char c : label) // a name that every file system and command line takes
        preset.key += std::isalnum(static_cast<unsigned char>(c)) != 0
                          ? static_cast<char>(std::tolower(static_cast<unsigned char>(c)))
                          : '-';
    for (const ParamRow& row : parameters.table().rows())
        if (row.key == "solver.method" || parameters.edited(row.key))
            preset.values.emplace_back(row.key, parameters.text(row.key));
    return preset;
}

void apply_preset(const Preset& preset, ParamSet& parameters) {
    for (const auto& [key, text] : preset.values)
        if (key == "solver.method")
            set_method(parameters, text);
    for (const auto& [key, text] : preset.values)
        if (key != "solver.method")
            parameters.set_text(key, text);
}

std::vector<PresetChange> preset_changes(const Preset& preset, const ParamSet& parameters) {
    ParamSet after = parameters;
    apply_preset(preset, after);
    std::vector<PresetChange> changes;
    for (const ParamRow& row : parameters.table().rows())
        if (const double a = parameters.get(row.key), b = after.get(row.key); a != b)
            changes.push_back({row.label, short_value(row, a), short_value(row, b)});
    return changes;
}

} // namespace fascicle
