#include "io/formats/vertex_weld.hpp"

#include <bit>
#include <cstdint>

namespace fascicle::io {
namespace {

/// Mixes all bits of the coordinates into all bits: multiplication and shifts of the finaliser of MurmurHash3 (A. Appleby, public
/// domain).
std::uint64_t hash(const Vec3& p) {
    std::uint64_t h = 0;
    for (int k = 0; k < 3; ++k) {
        h ^= std::bit_cast<std::uint64_t>(p[k] + 0.0); // -0 + 0 is 0
        h = (h ^ (h >> 33)) * 0xff51afd7ed558ccdull;
        h = (h ^ (h >> 33)) * 0xc4ceb9fe1a85ec53ull;
        h ^= h >> 33;
    }
    return h;
}

} // namespace

void VertexWeld::grow() {
    std::vector<int> larger(slots_.empty() ? 64 : 2 * slots_.size(), -1);
    const std::size_t mask = larger.size() - 1;
    for (std::size_t i = 0; i < points_.size(); ++i) {
        std::size_t at = hash(points_[i]) & mask;
        while (larger[at] >= 0)
            at = (at + 1) & mask;
        larger[at] = static_cast<int>(i);
    }
    slots_ = std::move(larger);
}

int VertexWeld::add(const Vec3& p) {
    if (2 * (points_.size() + 1) > slots_.size())
        grow();
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = hash(p) & mask;
    for (; slots_[at] >= 0; at = (at + 1) & mask)
        if (points_[static_cast<std::size_t>(slots_[at])] == p)
            return slots_[at];
    slots_[at] = static_cast<int>(points_.size());
    points_.push_back(p);
    return slots_[at];
}

} // namespace fascicle::io
