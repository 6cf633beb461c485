#pragma once
// Names that come from files and command lines, made fit to be shown, written as JSON, and to call a file by.

#include <string>
#include <string_view>

namespace fascicle {

/// Line breaks and other control characters become blanks: one name cannot break a line or steer a terminal.
std::string one_line(std::string_view text);

/// Bytes that are no UTF-8 (RFC 3629: no overlong forms, no surrogates) become U+FFFD each; what is UTF-8 stays as it is.
std::string valid_utf8(std::string_view text);

/// A name for a file, without extension, that stays in the folder that it is put into: separators and control characters
/// become '_', a leading dot gets one before it, and names of more than 150 bytes are cut and end in a hash of the whole.
std::string file_name_for(std::string_view name);

} // namespace fascicle
