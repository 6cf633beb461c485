#pragma once
// Bytes as text: base64 of RFC 4648 with padding.

#include <string>
#include <string_view>

namespace fascicle::io {

std::string encode_base64(std::string_view bytes);

/// Base64 to bytes. White space is passed over; false when anything else is wrong. Encoded runs may follow
/// each other, each with its own padding, as VTK writes header and data.
bool decode_base64(std::string_view text, std::string& out);

} // namespace fascicle::io
