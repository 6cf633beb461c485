#pragma once
// As much of JSON Schema as resources/ uses, to check files that the program writes.

#include <nlohmann/json.hpp>
#include <regex>
#include <stdexcept>
#include <string>

namespace fascicle::test {

/// Empty when `value` is as `schema` wants it; else where it is not. Throws when the schema uses a word that is not
/// understood here, so that nothing is passed over.
inline std::string schema_fault(const nlohmann::json& value, const nlohmann::json& schema,
                                const nlohmann::json& root, const std::string& where = "$") {
    using nlohmann::json;
    const auto is = [&](const std::string& type) {
        return type == "object"    ? value.is_object()
               : type == "array"   ? value.is_array()
               : type == "string"  ? value.is_string()
               : type == "number"  ? value.is_number()
               : type == "integer" ? value.is_number_integer()
               : type == "boolean" ? value.is_boolean()
                                   : throw std::runtime_error("type " + type);
    };
    const auto recurse = [&](const json& part, const json& inner, const std::string& place) {
        return schema_fault(part, inner, root, place);
    };
    for (const auto& [word, wanted] : schema.items()) {
        std::string fault;
        if (word == "$schema" || word == "title" || word == "description" || word == "$defs") {
            continue;
        } else if (word == "$ref") {
            fault = recurse(value, root.at(json::json_pointer(wanted.get<std::string>().substr(1))), where);
        } else if (word == "type") {
            bool fits = false;
            for (const json& type : wanted.is_array() ? wanted : json::array({wanted}))
                fits |= is(type.get<std::string>());
            fault = fits ? "" : where + ": type";
        } else if (word == "enum") {
            fault = std::count(wanted.begin(), wanted.end(), value) > 0 ? "" : where + ": enum";
        } else if (word == "anyOf") {
            fault = where + ": anyOf";
            for (const json& one : wanted)
                if (recurse(value, one, where).empty())
                    fault.clear();
        } else if (word == "allOf") {
            for (const json& one : wanted)
                fault += recurse(value, one, where);
        } else if (word == "required") {
            for (const json& name : wanted)
                if (value.is_object() && !value.contains(name.get<std::string>()))
                    fault = where + ": no " + name.get<std::string>();
        } else if (word == "properties") {
            for (const auto& [name, inner] : wanted.items())
                if (value.is_object() && value.contains(name) && fault.empty())
                    fault = recurse(value.at(name), inner, where + "." + name);
        } else if (word == "additionalProperties") {
            for (const auto& [name, inner] : value.items())
                if (!(schema.contains("properties") && schema.at("properties").contains(name)) &&
                    fault.empty())
                    fault = recurse(inner, wanted, where + "." + name);
        } else if (word == "items") {
            for (std::size_t i = 0; value.is_array() && i < value.size() && fault.empty(); ++i)
                fault = recurse(value[i], wanted, where + "[" + std::to_string(i) + "]");
        } else if (word == "minimum" || word == "maximum") {
            const bool fits = !value.is_number() || (word == "minimum" ? value.get<double>() >= wanted
                                                                       : value.get<double>() <= wanted);
            fault = fits ? "" : where + ": " + word;
        } else if (word == "minItems" || word == "maxItems") {
            const bool fits =
                !value.is_array() || (word == "minItems" ? value.size() >= wanted.get<std::size_t>()
                                                         : value.size() <= wanted.get<std::size_t>());
            fault = fits ? "" : where + ": " + word;
        } else if (word == "minLength") {
            fault = !value.is_string() || value.get<std::string>().size() >= wanted.get<std::size_t>()
                        ? ""
                        : where + ": " + word;
        } else if (word == "pattern") {
            // std::regex recurses once a character: long texts are looked at in pieces' beginning only.
            const std::string text = value.is_string() ? value.get<std::string>().substr(0, 2000) : "";
            fault = !value.is_string() || std::regex_search(text, std::regex(wanted.get<std::string>()))
                        ? ""
                        : where + ": pattern";
        } else {
            throw std::runtime_error("schema word " + word);
        }
        if (!fault.empty())
            return fault;
    }
    return {};
}

} // namespace fascicle::test
