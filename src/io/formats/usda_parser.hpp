#pragma once
// The text of a USD layer as prims and attributes, without their meaning.

#include "io/formats/text_scanner.hpp"

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace fascicle::io {

/// A value: the numbers of tuples and lists one after another, or texts (strings, tokens, paths).
struct UsdaValue {
    std::vector<double> numbers;
    std::vector<std::string> texts;
};

struct UsdaAttribute {
    std::string type; ///< "point3f[]"
    UsdaValue value;  ///< outside of time samples
    std::map<double, UsdaValue> samples;
    std::size_t place = 0; ///< byte, for messages
};

struct UsdaPrim {
    std::string type, name;
    std::map<std::string, UsdaValue> metadata; ///< single values alone
    std::map<std::string, UsdaAttribute> attributes;
    std::vector<std::unique_ptr<UsdaPrim>> children;
    std::size_t place = 0;
};

struct UsdaLayer {
    std::map<std::string, UsdaValue> metadata;
    std::vector<std::unique_ptr<UsdaPrim>> prims;
};

/// Error naming file and line for what is no USD text, and for what needs other files or layers (references, payloads, variants, over,
/// class). At most 100,000 prims, a million attributes and 50 levels.
UsdaLayer parse_usda(std::string_view bytes, const std::string& file);

} // namespace fascicle::io
