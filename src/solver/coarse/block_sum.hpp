#pragma once
// Sums of outer products by pairs of clusters: the matrix of the coarse correction while it is being made. Blocks lie apart and aligned,
// where the columns of a band overlap: a sum written to a band waits for the one before it.

#include "fascicle/base/bytes_of.hpp"

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace fascicle::solver {

class BandedCholesky;

/// Which pairs of clusters have a block. Pairs (a, b) with a >= b.
class BlockPattern {
public:
    BlockPattern() = default;
    /// pairs: each once, a - b < width.
    BlockPattern(int clusters, int width, std::vector<std::pair<int, int>> pairs);
    const std::vector<std::pair<int, int>>& pairs() const { return pairs_; }
    int width() const { return width_; }
    /// By b * width + (a - b): the number of the pair, -1 where there is none.
    const std::vector<int>& places() const { return places_; }
    int place(int a, int b) const { return places_[static_cast<std::size_t>(b * width_ + a - b)]; }
    std::size_t bytes() const { return bytes_of(pairs_, places_); }

private:
    int width_ = 1;
    std::vector<std::pair<int, int>> pairs_;
    std::vector<int> places_;
};

class BlockSum {
public:
    /// Six numbers and room for two zeros.
    using Six = std::array<float, 8>;
    /// Column j of the pair's block at 8 j: rows of the first cluster.
    struct alignas(64) Block {
        std::array<float, 48> v;
    };

    /// All blocks of the pattern, zero.
    void reset(const BlockPattern& pattern);
    /// Adds v v^T, where v has the six values row[k] of cluster[k], zero elsewhere; clusters all differ and every pair is in
    /// the pattern.
    void add_outer(const BlockPattern& pattern, const int* cluster, const Six* row, int count);
    Block& block(int place) { return blocks_[static_cast<std::size_t>(place)]; }
    const Block& block(int place) const { return blocks_[static_cast<std::size_t>(place)]; }
    std::size_t bytes() const { return bytes_of(blocks_); }

private:
    std::vector<Block> blocks_;
};

} // namespace fascicle::solver
