#pragma once
// Keeps what a project file says and this version does not understand.

#include "io/json_fields.hpp"

namespace fascicle::io {

/// Adds to `fresh`, a project about to be written, the fields of the file it came from that this version does not know, at
/// every level. Entries of lists are found again by what they are: by name (or path, when renamed), bone, kind, frame.
void keep_unknown_fields(Json& fresh, const Json& previous);

} // namespace fascicle::io
