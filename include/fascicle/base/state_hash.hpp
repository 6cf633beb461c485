#pragma once
// A 64-bit FNV-1a hash of bytes: tells whether two states or two files are the same, not a cryptographic
// promise.

#include "fascicle/base/types.hpp"

#include <cstddef>
#include <cstdint>
#include <string>

namespace fascicle {

class StateHash {
public:
    void add_bytes(const void* data, std::size_t size);
    /// Adds the bit patterns of all coordinates in order; -0.0 counts as 0.0.
    void add_points(const Points& points);
    std::uint64_t value() const { return value_; }
    /// 16 lower-case hexadecimal digits.
    std::string hex() const;

private:
    std::uint64_t value_ = 14695981039346656037ull;
};

} // namespace fascicle
