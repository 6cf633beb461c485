#include "fascicle/io/fibre_template_file.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/io/files.hpp"
#include "io/built_in_templates.hpp"
#include "io/json_fields.hpp"

#include <cmath>

namespace fascicle {

namespace {

constexpr const char* format_name = "fascicle fibre template";
constexpr int newest_version = 1;

std::vector<Vec2> points_of(const io::JsonFields& polygon) {
    const auto found = polygon.json().find("points");
    if (found == polygon.json().end() || !found->is_array())
        polygon.fail("points", "missing", "an array of points [x, y]");
    std::vector<Vec2> points;
    for (const io::Json& entry : *found) {
        if (!entry.is_array() || entry.size() != 2 || !entry[0].is_number() || !entry[1].is_number())
            polygon.fail("points[" + std::to_string(points.size()) + "]", "got " + entry.dump().substr(0, 40),
                         "[x, y]");
        points.emplace_back(entry[0].get<double>(), entry[1].get<double>());
    }
    return points;
}

std::vector<FibrePolygon> side_of(const io::JsonFields& file, const char* key) {
    std::vector<FibrePolygon> side;
    for (const io::JsonFields& entry : file.objects(key)) {
        if (!entry.has("s"))
            entry.fail("s", "missing", "the polygon's place across, from 0 to 1");
        side.push_back({entry.number("s", 0.0), points_of(entry), entry.number("weight", 1.0)});
    }
    return side;
}

} // namespace

FibreTemplate parse_fibre_template(std::string_view bytes, const std::string& file) {
    const io::Json json = io::parse_json_object(bytes, file);
    const io::JsonFields fields(json, file, "");
    fields.require_format(format_name, newest_version);
    FibreTemplate result;
    result.key = fields.text("key", std::filesystem::path(file).stem().string());
    if (result.key.empty())
        fields.fail("key", "empty", "a short name");
    result.label = fields.text("label", result.key);
    result.meaning = fields.text("meaning");
    result.front = side_of(fields, "front");
    result.back = side_of(fields, "back");
    check_template(result, file);
    return result;
}

FibreTemplate read_fibre_template(const std::filesystem::path& path) {
    return parse_fibre_template(read_file(path, std::size_t{1} << 20), path.string());
}

const std::vector<FibreTemplate>& built_in_fibre_templates() {
    static const std::vector<FibreTemplate> templates = [] {
        std::vector<FibreTemplate> all;
        for (const io::BuiltInFile& file : io::built_in_template_files())
            all.push_back(parse_fibre_template(file.text, std::string(file.name)));
        return all;
    }();
    return templates;
}

FibreTemplate find_fibre_template(const std::string& key_or_path) {
    std::string keys;
    for (const FibreTemplate& built_in : built_in_fibre_templates()) {
        if (built_in.key == key_or_path)
            return built_in;
        keys += built_in.key + ", ";
    }
    std::error_code ignored;
    if (!std::filesystem::exists(key_or_path, ignored))
        throw_error("fibre template '" + key_or_path + "'", "neither built in nor a file",
                    keys + "or the path of a template file");
    return read_fibre_template(key_or_path);
}

} // namespace fascicle
