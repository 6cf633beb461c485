#pragma once
// Which program this is, for --version and for the summary of a run.

namespace fascicle {

const char* program_version(); ///< e.g. "0.1.0"
const char* compiler_name();   ///< e.g. "GNU 12.2.0"
const char* build_type();      ///< e.g. "Release"

} // namespace fascicle
