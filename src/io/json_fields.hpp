#pragma once
// Typed access to JSON from files, with errors that name the file and the field.

#include "fascicle/base/types.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace fascicle::io {

using Json = nlohmann::ordered_json;

/// Error naming file and line when the text is no JSON or not an object.
Json parse_json_object(std::string_view text, const std::string& file);

/// One object of a file, for reading its fields.
class JsonFields {
public:
    /// `path` is how the object is reached, for messages: "muscles[0]"; empty for the outermost.
    JsonFields(const Json& json, std::string file, std::string path);

    bool has(const char* key) const;
    /// Value of a field; Error when it is there with another type. The default when it is missing or null.
    std::string text(const char* key, const std::string& otherwise = {}) const;
    double number(const char* key, double otherwise) const;
    int integer(const char* key, int otherwise) const;
    bool flag(const char* key, bool otherwise) const;
    /// `count` finite numbers in an array.
    std::vector<double> numbers(const char* key, std::size_t count) const;
    Vec3 vector(const char* key) const;
    /// Objects of an array; none when it is missing.
    std::vector<JsonFields> objects(const char* key) const;
    /// Object of a field, which must be there.
    JsonFields object(const char* key) const;
    const Json& json() const { return *json_; }
    /// Error unless the field `format` is this one and `version` (1 when missing) is 1 to `newest`.
    void require_format(const std::string& format, int newest) const;

    [[noreturn]] void fail(const std::string& key, const std::string& what,
                           const std::string& expected = {}) const;

private:
    const Json* find(const char* key) const;
    const Json* json_;
    std::string file_, path_;
};

} // namespace fascicle::io
