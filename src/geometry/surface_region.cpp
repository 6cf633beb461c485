#include "fascicle/geometry/surface_region.hpp"

#include "fascicle/base/assert.hpp"

#include <algorithm>

namespace fascicle {

SurfaceRegion::SurfaceRegion(int vertex_count) : vertex_count_(vertex_count) {
    FASCICLE_ASSERT(vertex_count >= 0);
    words_.assign((static_cast<std::size_t>(vertex_count) + 63) / 64, 0);
}

SurfaceRegion::SurfaceRegion(int vertex_count, std::span<const int> vertices) : SurfaceRegion(vertex_count) {
    insert(vertices);
}

void SurfaceRegion::insert(std::span<const int> vertices) {
    for (const int v : vertices) {
        FASCICLE_ASSERT(v >= 0 && v < vertex_count_);
        insert(v);
    }
}

void SurfaceRegion::erase(std::span<const int> vertices) {
    for (const int v : vertices) {
        FASCICLE_ASSERT(v >= 0 && v < vertex_count_);
        erase(v);
    }
}

int SurfaceRegion::size() const {
    int count = 0;
    for (const std::uint64_t word : words_)
        count += std::popcount(word);
    return count;
}

bool SurfaceRegion::empty() const {
    return std::all_of(words_.begin(), words_.end(), [](std::uint64_t word) { return word == 0; });
}

std::vector<int> SurfaceRegion::vertices() const {
    std::vector<int> list;
    list.reserve(static_cast<std::size_t>(size()));
    for_each([&](int v) { list.push_back(v); });
    return list;
}

SurfaceRegion& SurfaceRegion::operator|=(const SurfaceRegion& other) {
    FASCICLE_ASSERT(vertex_count_ == other.vertex_count_);
    for (std::size_t w = 0; w < words_.size(); ++w)
        words_[w] |= other.words_[w];
    return *this;
}

SurfaceRegion& SurfaceRegion::operator&=(const SurfaceRegion& other) {
    FASCICLE_ASSERT(vertex_count_ == other.vertex_count_);
    for (std::size_t w = 0; w < words_.size(); ++w)
        words_[w] &= other.words_[w];
    return *this;
}

SurfaceRegion& SurfaceRegion::operator-=(const SurfaceRegion& other) {
    FASCICLE_ASSERT(vertex_count_ == other.vertex_count_);
    for (std::size_t w = 0; w < words_.size(); ++w)
        words_[w] &= ~other.words_[w];
    return *this;
}

SurfaceRegion SurfaceRegion::complement() const {
    SurfaceRegion result = *this;
    for (std::uint64_t& word : result.words_)
        word = ~word;
    if (vertex_count_ % 64 != 0)
        result.words_.back() &= (std::uint64_t{1} << (vertex_count_ % 64)) - 1;
    return result;
}

bool SurfaceRegion::intersects(const SurfaceRegion& other) const {
    FASCICLE_ASSERT(vertex_count_ == other.vertex_count_);
    for (std::size_t w = 0; w < words_.size(); ++w)
        if ((words_[w] & other.words_[w]) != 0)
            return true;
    return false;
}

bool SurfaceRegion::includes(const SurfaceRegion& other) const {
    FASCICLE_ASSERT(vertex_count_ == other.vertex_count_);
    for (std::size_t w = 0; w < words_.size(); ++w)
        if ((other.words_[w] & ~words_[w]) != 0)
            return false;
    return true;
}

} // namespace fascicle
