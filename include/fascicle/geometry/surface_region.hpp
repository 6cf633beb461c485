#pragma once
// A set of vertices of one surface: what a paint tool paints. One bit a vertex, so copies are cheap (16 kB for a
// bone of 250,000 triangles) and an undo list may hold hundreds.

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace fascicle {

/// Knows how many vertices its surface has and nothing else of it. Vertex numbers must be in [0, vertex_count());
/// both sides of a set operation must have the same count (FASCICLE_ASSERT).
class SurfaceRegion {
public:
    SurfaceRegion() = default; ///< of a surface without vertices
    explicit SurfaceRegion(int vertex_count);
    SurfaceRegion(int vertex_count, std::span<const int> vertices);

    int vertex_count() const { return vertex_count_; }
    bool contains(int v) const { return (words_[word_of(v)] >> (v & 63) & 1u) != 0; }
    void insert(int v) { words_[word_of(v)] |= bit_of(v); }
    void erase(int v) { words_[word_of(v)] &= ~bit_of(v); }
    void insert(std::span<const int> vertices);
    void erase(std::span<const int> vertices);

    int size() const;
    bool empty() const;
    /// Ascending.
    std::vector<int> vertices() const;
    /// Calls visit(v) for every vertex, ascending.
    template <typename Visit>
    void for_each(const Visit& visit) const {
        for (std::size_t w = 0; w < words_.size(); ++w)
            for (std::uint64_t rest = words_[w]; rest != 0; rest &= rest - 1)
                visit(static_cast<int>(64 * w) + std::countr_zero(rest));
    }

    SurfaceRegion& operator|=(const SurfaceRegion& other);
    SurfaceRegion& operator&=(const SurfaceRegion& other);
    SurfaceRegion& operator-=(const SurfaceRegion& other);
    /// Every vertex that is not in it.
    SurfaceRegion complement() const;
    bool intersects(const SurfaceRegion& other) const;
    bool includes(const SurfaceRegion& other) const;
    friend bool operator==(const SurfaceRegion&, const SurfaceRegion&) = default;

    std::size_t bytes() const { return words_.size() * sizeof(std::uint64_t); }

private:
    static std::size_t word_of(int v) { return static_cast<std::size_t>(v) / 64; }
    static std::uint64_t bit_of(int v) { return std::uint64_t{1} << (v & 63); }

    int vertex_count_ = 0;
    std::vector<std::uint64_t> words_; ///< bits beyond the last vertex are zero
};

inline SurfaceRegion operator|(SurfaceRegion a, const SurfaceRegion& b) {
    return a |= b;
}
inline SurfaceRegion operator&(SurfaceRegion a, const SurfaceRegion& b) {
    return a &= b;
}
inline SurfaceRegion operator-(SurfaceRegion a, const SurfaceRegion& b) {
    return a -= b;
}

} // namespace fascicle
