// FASCICLE_FUZZ_GROUP: a function of targets.hpp.
#include "fuzz/targets.hpp"

namespace fascicle::fuzz {

const std::vector<Target>& targets() {
    static const std::vector<Target> rows = FASCICLE_FUZZ_GROUP();
    return rows;
}

} // namespace fascicle::fuzz
