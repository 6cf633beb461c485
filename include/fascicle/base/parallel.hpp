#pragma once
// Deterministic parallel loop: the chunk borders depend on n and chunk only, never on the number of threads.

#include <cstddef>
#include <functional>

namespace fascicle {

/// Calls body(begin, end) for consecutive chunks of [0, n), on up to `threads` threads (1: in order, on this
/// thread). body must write only to places that belong to its own indices; reductions go into one slot per
/// chunk, summed afterwards in chunk order. The first exception of a body is rethrown here.
void parallel_for(int threads, std::size_t n, std::size_t chunk,
                  const std::function<void(std::size_t begin, std::size_t end)>& body);

/// Threads of the machine, at least 1.
int hardware_threads();

} // namespace fascicle
