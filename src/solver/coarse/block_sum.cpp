#include "solver/coarse/block_sum.hpp"

#include "solver/coarse/wide.hpp"

#include <cstring>

namespace fascicle::solver {

namespace {

/// Written out, since the compiler left alone takes the six columns for its lanes and transposes every block twice.
using Column = float __attribute__((vector_size(32), may_alias));

FASCICLE_WIDE void add_pairs(BlockSum::Block* blocks, const int* places, int width, const int* cluster,
                             const BlockSum::Six* row, int count) {
    for (int k = 0; k < count; ++k) {
        Column a;
        std::memcpy(&a, row[k].data(), sizeof a);
        for (int l = 0; l < count; ++l) {
            if (cluster[k] < cluster[l])
                continue;
            const float* const b = row[l].data();
            auto* const to = reinterpret_cast<Column*>(
                blocks[places[cluster[l] * width + cluster[k] - cluster[l]]].v.data());
            for (int j = 0; j < 6; ++j)
                to[j] += a * b[j];
        }
    }
}

} // namespace

BlockPattern::BlockPattern(int clusters, int width, std::vector<std::pair<int, int>> pairs)
    : width_(width), pairs_(std::move(pairs)),
      places_(static_cast<std::size_t>(clusters) * static_cast<std::size_t>(width), -1) {
    for (std::size_t i = 0; i < pairs_.size(); ++i)
        places_[static_cast<std::size_t>(pairs_[i].second * width + pairs_[i].first - pairs_[i].second)] =
            static_cast<int>(i);
}

void BlockSum::reset(const BlockPattern& pattern) {
    blocks_.assign(pattern.pairs().size(), Block{});
}

void BlockSum::add_outer(const BlockPattern& pattern, const int* cluster, const Six* row, int count) {
    add_pairs(blocks_.data(), pattern.places().data(), pattern.width(), cluster, row, count);
}

} // namespace fascicle::solver
