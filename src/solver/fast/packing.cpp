#include "solver/fast/packing.hpp"

#include <algorithm>
#include <cstdint>

namespace fascicle::solver::fast {

namespace {

/// Which colours a vertex has already: a row of bits per vertex that the set touches, grown when a colour is opened.
class ColourBits {
public:
    ColourBits(std::size_t low, std::size_t count) : low_(low), bits_(count, 0), count_(count) {}

    /// Colours in use at a vertex, word w.
    std::uint64_t word(int record, std::size_t w) const { return bits_[w * count_ + place(record)]; }
    void add(int record, std::size_t colour) {
        bits_[colour / 64 * count_ + place(record)] |= std::uint64_t{1} << (colour % 64);
    }
    void grow() { bits_.resize(bits_.size() + count_, 0); }
    std::size_t words() const { return count_ == 0 ? 0 : bits_.size() / count_; }

private:
    std::size_t place(int record) const { return static_cast<std::size_t>(record) - low_; }

    std::size_t low_;
    std::vector<std::uint64_t> bits_;
    std::size_t count_;
};

} // namespace

bool pack(std::span<const int> corners, std::size_t arity, const std::vector<bool>& movable,
          std::vector<int>& rows) {
    rows.clear();
    if (corners.empty())
        return true;
    const auto [low, high] = std::minmax_element(corners.begin(), corners.end());
    ColourBits used(static_cast<std::size_t>(*low), static_cast<std::size_t>(*high - *low) + 1);
    std::vector<std::vector<int>> colours;
    const std::size_t count = corners.size() / arity;
    for (std::size_t c = 0; c < count; ++c) {
        const auto mine = corners.subspan(c * arity, arity);
        std::size_t best = colours.size();
        for (std::size_t w = 0; w < used.words(); ++w) {
            std::uint64_t taken = 0;
            for (const int v : mine)
                if (movable[static_cast<std::size_t>(v)])
                    taken |= used.word(v, w);
            for (std::size_t k = 64 * w; k < std::min(colours.size(), 64 * (w + 1)); ++k)
                if ((taken >> (k % 64) & 1u) == 0 &&
                    (best == colours.size() || colours[k].size() < colours[best].size()))
                    best = k;
        }
        if (best == colours.size()) {
            if (best == max_colours)
                return false;
            if (best == 64 * used.words())
                used.grow();
            colours.emplace_back();
        }
        colours[best].push_back(static_cast<int>(c));
        for (const int v : mine)
            if (movable[static_cast<std::size_t>(v)])
                used.add(v, best);
    }
    for (const std::vector<int>& colour : colours) {
        rows.insert(rows.end(), colour.begin(), colour.end());
        rows.resize((rows.size() + packet - 1) / packet * packet, -1);
    }
    return true;
}

} // namespace fascicle::solver::fast
