#pragma once
// Names of arrays where the format wants one word.

#include <string>
#include <string_view>

namespace fascicle::io {

/// What would end a word, and the sign itself, stands as % and two hexadecimal digits, as VTK does it.
std::string encoded_name(std::string_view name);
/// What encoded_name makes of a name, taken back.
std::string decoded_name(std::string_view name);
/// One byte as % and two hexadecimal digits.
std::string encoded_byte(char c);

} // namespace fascicle::io
