#include "io/json_fields.hpp"

#include "fascicle/base/error.hpp"
#include "io/formats/text_scanner.hpp"

#include <cmath>
#include <limits>

namespace fascicle::io {
namespace {

/// Deeper nesting than any of our files has is refused before the parser builds it.
bool nested_too_deeply(std::string_view text) {
    int depth = 0;
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quoted) {
            i += c == '\\' ? 1 : 0;
            quoted = c != '"';
        } else if (c == '"') {
            quoted = true;
        } else if (c == '[' || c == '{') {
            if (++depth > 100)
                return true;
        } else if (c == ']' || c == '}') {
            --depth;
        }
    }
    return false;
}

} // namespace

Json parse_json_object(std::string_view text, const std::string& file) {
    if (nested_too_deeply(text))
        throw_error(file, "brackets nested too deeply", "at most 100 levels");
    Json json;
    try {
        json = Json::parse(text);
    } catch (const Json::parse_error& error) {
        TextScanner(text, file).fail_at(error.byte == 0 ? 0 : error.byte - 1, "not valid JSON here", "JSON");
    } catch (const Json::exception&) { // its words would repeat all digits
        throw_error(file, "not valid JSON: a number is out of range", "numbers up to 1e308");
    }
    if (!json.is_object())
        throw_error(file, "the file holds no JSON object", "{ ... }");
    return json;
}

JsonFields::JsonFields(const Json& json, std::string file, std::string path)
    : json_(&json), file_(std::move(file)), path_(std::move(path)) {
    if (!json.is_object())
        throw_error(file_, path_ + " is " + json.type_name(), "an object");
}

void JsonFields::fail(const std::string& key, const std::string& what, const std::string& expected) const {
    throw_error(file_ + ", field " + (path_.empty() ? key : path_ + "." + key), what, expected);
}

const Json* JsonFields::find(const char* key) const {
    const auto it = json_->find(key);
    return it == json_->end() || it->is_null() ? nullptr : &*it;
}

bool JsonFields::has(const char* key) const {
    return find(key) != nullptr;
}

std::string JsonFields::text(const char* key, const std::string& otherwise) const {
    const Json* value = find(key);
    if (value != nullptr && !value->is_string())
        fail(key, std::string("got ") + value->type_name(), "a text");
    return value == nullptr ? otherwise : value->get<std::string>();
}

double JsonFields::number(const char* key, double otherwise) const {
    const Json* value = find(key);
    if (value != nullptr && (!value->is_number() || !std::isfinite(value->get<double>())))
        fail(key, std::string("got ") + value->type_name(), "a finite number");
    return value == nullptr ? otherwise : value->get<double>();
}

int JsonFields::integer(const char* key, int otherwise) const {
    const double value = number(key, otherwise);
    if (value != std::floor(value) || std::abs(value) > std::numeric_limits<int>::max())
        fail(key, "got a number that is not whole or too large", "a whole number");
    return static_cast<int>(value);
}

bool JsonFields::flag(const char* key, bool otherwise) const {
    const Json* value = find(key);
    if (value != nullptr && !value->is_boolean())
        fail(key, std::string("got ") + value->type_name(), "true or false");
    return value == nullptr ? otherwise : value->get<bool>();
}

std::vector<double> JsonFields::numbers(const char* key, std::size_t count) const {
    const Json* value = find(key);
    const std::string expected = "a list of " + std::to_string(count) + " finite numbers";
    if (value == nullptr || !value->is_array() || value->size() != count)
        fail(key, value == nullptr ? "missing" : "not such a list", expected);
    std::vector<double> out;
    for (const Json& item : *value) {
        if (!item.is_number() || !std::isfinite(item.get<double>()))
            fail(key, "not such a list", expected);
        out.push_back(item.get<double>());
    }
    return out;
}

Vec3 JsonFields::vector(const char* key) const {
    const std::vector<double> v = numbers(key, 3);
    return {v[0], v[1], v[2]};
}

std::vector<JsonFields> JsonFields::objects(const char* key) const {
    const Json* value = find(key);
    if (value != nullptr && !value->is_array())
        fail(key, std::string("got ") + value->type_name(), "a list");
    std::vector<JsonFields> out;
    if (value != nullptr)
        for (std::size_t i = 0; i < value->size(); ++i)
            out.emplace_back((*value)[i], file_,
                             (path_.empty() ? "" : path_ + ".") + std::string(key) + "[" + std::to_string(i) +
                                 "]");
    return out;
}

JsonFields JsonFields::object(const char* key) const {
    const Json* value = find(key);
    if (value == nullptr)
        fail(key, "missing", "an object");
    return {*value, file_, path_.empty() ? key : path_ + "." + key};
}

void JsonFields::require_format(const std::string& format, int newest) const {
    if (text("format") != format)
        fail("format", has("format") ? "got '" + text("format") + "'" : "missing", "\"" + format + "\"");
    if (const int version = integer("version", 1); version < 1 || version > newest)
        fail("version", "got " + std::to_string(version),
             newest == 1 ? "1" : "1 to " + std::to_string(newest));
}

} // namespace fascicle::io
