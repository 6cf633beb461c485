#pragma once
// On what, and by what, a bench was measured.

#include <cstddef>
#include <string>

namespace fascicle::bench {

struct Machine {
    std::string cpu = "unknown";
    int cores = 0;            ///< hardware threads this program may use
    std::string instructions; ///< widest known: "avx512", "avx2+fma", "portable"
    std::size_t l1_bytes = 0; ///< data cache of one core, 0 unknown; as the next two
    std::size_t l2_bytes = 0;
    std::size_t l3_bytes = 0;
    double load = -1; ///< programs running on average over the last minute, before the bench; -1 unknown
    std::string compiler, flags, build, version;

    /// Whether other programs took a noticeable part of the machine before the bench began.
    bool busy() const { return load > 0.3; }
};

/// Reads /proc and /sys; what the system does not tell stays unknown.
Machine this_machine();

} // namespace fascicle::bench
