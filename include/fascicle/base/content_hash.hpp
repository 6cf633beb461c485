#pragma once
// A fast 128-bit hash of large pieces of memory: names and checks things that were computed before. Not a
// cryptographic promise.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace fascicle {

/// Four lanes of 8 bytes each, multiplied and rotated word by word (a bijection of the lane for every word, so that no
/// single damaged word goes unseen). Depends on the bytes, on how they were divided among calls, and on the machine's
/// byte order.
class ContentHash {
public:
    void add_bytes(const void* data, std::size_t size);
    void add_number(double x) { add_bytes(&x, sizeof x); }
    void add_number(std::uint64_t x) { add_bytes(&x, sizeof x); }
    std::array<std::uint64_t, 2> value() const;
    /// 32 lower-case hexadecimal digits.
    std::string hex() const;

private:
    std::array<std::uint64_t, 4> lanes_{0x243f6a8885a308d3u, 0x13198a2e03707344u, 0xa4093822299f31d0u,
                                        0x082efa98ec4e6c89u}; // digits of pi
};

} // namespace fascicle
