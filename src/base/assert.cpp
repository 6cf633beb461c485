#include "fascicle/base/assert.hpp"

#include <cstdio>
#include <cstdlib>

namespace fascicle::detail {

void assertion_failed(const char* condition, const char* file, int line) {
    std::fprintf(stderr, "fascicle: internal error: %s does not hold (%s:%d)\n", condition, file, line);
    std::abort();
}

} // namespace fascicle::detail
