#pragma once
// Numbers that look random and depend on a seed and a place alone, not on the order in which they are asked for.

#include <cstdint>

namespace fascicle::chmd {

/// Uniform in [0, 1): the 64 bit mixer of Steele, Lea, Flood 2014 ("SplittableRandom") over seed and place.
inline double hash_uniform(std::uint64_t seed, std::uint64_t place) {
    std::uint64_t x = seed * 0xd1342543de82ef95ull + (place + 1) * 0x9e3779b97f4a7c15ull;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
    x ^= x >> 31;
    return static_cast<double>(x >> 11) * 0x1p-53;
}

} // namespace fascicle::chmd
