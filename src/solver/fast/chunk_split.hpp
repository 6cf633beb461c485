#pragma once
// Which chunks of vertices each thread takes: ranges without gaps, so that a thread keeps meeting the same data, with borders that follow
// the measured times, since vertices in contact cost more than others. Results do not depend on the borders.

#include <cstddef>
#include <vector>

namespace fascicle::solver::fast {

class ChunkSplit {
public:
    ChunkSplit(std::size_t chunks, int threads) : busy_(static_cast<std::size_t>(threads)) {
        for (std::size_t t = 0; t <= busy_.size(); ++t)
            ends_.push_back(chunks * t / busy_.size());
    }

    std::size_t begin(int thread) const { return ends_[static_cast<std::size_t>(thread)]; }
    std::size_t end(int thread) const { return ends_[static_cast<std::size_t>(thread) + 1]; }
    /// A thread tells how long it worked on its chunks, s; each its own.
    void add(int thread, double seconds) { busy_[static_cast<std::size_t>(thread)].seconds += seconds; }
    /// Moves each border by one chunk towards the slower neighbour; with no thread at work.
    void balance() {
        for (std::size_t t = 0; t + 1 < busy_.size(); ++t) {
            const double left = busy_[t].seconds, right = busy_[t + 1].seconds;
            if (left > tolerance * right && ends_[t + 1] > ends_[t] + 1)
                --ends_[t + 1];
            else if (right > tolerance * left && ends_[t + 1] + 1 < ends_[t + 2])
                ++ends_[t + 1];
        }
        for (Busy& b : busy_)
            b.seconds = 0.0;
    }

private:
    static constexpr double tolerance = 1.1;
    struct alignas(64) Busy {
        double seconds = 0;
    };
    std::vector<std::size_t> ends_;
    std::vector<Busy> busy_;
};

} // namespace fascicle::solver::fast
