#pragma once
// How much memory vectors hold.

#include <cstddef>
#include <vector>

namespace fascicle {

/// Bytes that the vectors have taken from the heap, room to grow included.
template <typename... T>
std::size_t bytes_of(const std::vector<T>&... vectors) {
    return (std::size_t{0} + ... + (vectors.capacity() * sizeof(T)));
}

} // namespace fascicle
