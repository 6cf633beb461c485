#include "fascicle/base/build_info.hpp"

namespace fascicle {

// The macros are set for this file alone, by its CMakeLists.txt.
const char* program_version() {
    return FASCICLE_VERSION;
}

const char* compiler_name() {
    return FASCICLE_COMPILER;
}

const char* build_type() {
    return FASCICLE_BUILD_TYPE;
}

} // namespace fascicle
