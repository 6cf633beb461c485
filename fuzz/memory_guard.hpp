#pragma once
// Counts the heap: all of it under AddressSanitizer (its hooks see malloc), what operator new gives in other builds.

#include <cstddef>

namespace fascicle::fuzz {

/// Bytes that are allocated now, and the most there were since the last reset_peak_memory().
std::size_t live_memory();
std::size_t peak_memory();
void reset_peak_memory();

} // namespace fascicle::fuzz
