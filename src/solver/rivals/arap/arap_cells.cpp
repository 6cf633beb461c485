#include "solver/rivals/arap/arap_cells.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/parallel.hpp"
#include "solver/rivals/best_rotation.hpp"

namespace fascicle::solver {

namespace {

constexpr std::size_t chunk = 512;

} // namespace

ArapCells::ArapCells(const Points& rest, const MeshTopology& topology, const std::vector<double>& weights)
    : starts_(rest.size() + 1, 0), diagonal_(rest.size(), 0.0) {
    FASCICLE_ASSERT(weights.size() == topology.edges().size());
    for (const Edge& edge : topology.edges()) {
        ++starts_[static_cast<std::size_t>(edge.a) + 1];
        ++starts_[static_cast<std::size_t>(edge.b) + 1];
    }
    for (std::size_t i = 1; i < starts_.size(); ++i)
        starts_[i] += starts_[i - 1];
    links_.resize(starts_.back());
    std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
    for (std::size_t e = 0; e < weights.size(); ++e) {
        const auto a = static_cast<std::size_t>(topology.edges()[e].a);
        const auto b = static_cast<std::size_t>(topology.edges()[e].b);
        links_[next[a]++] = {static_cast<int>(b), weights[e], rest[a] - rest[b]};
        links_[next[b]++] = {static_cast<int>(a), weights[e], rest[b] - rest[a]};
        diagonal_[a] += weights[e];
        diagonal_[b] += weights[e];
    }
}

double ArapCells::energy(const Points& x, const std::vector<Mat3>& rotations) const {
    double sum = 0;
    for (std::size_t i = 0; i < size(); ++i)
        for (const Link& link : links(i))
            sum += link.weight *
                   (x[i] - x[static_cast<std::size_t>(link.other)] - rotations[i] * link.rest).squaredNorm();
    return sum;
}

Points ArapCells::gradient(const Points& x, const std::vector<Mat3>& rotations) const {
    Points result(size(), Vec3::Zero());
    for (std::size_t i = 0; i < size(); ++i)
        for (const Link& link : links(i)) {
            const auto j = static_cast<std::size_t>(link.other);
            result[i] +=
                4.0 * link.weight * (x[i] - x[j] - 0.5 * ((rotations[i] + rotations[j]) * link.rest));
        }
    return result;
}

void ArapCells::fit(const Points& x, std::vector<Mat3>& rotations, int threads) const {
    rotations.resize(size());
    parallel_for(threads, size(), chunk, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            Mat3 s = Mat3::Zero();
            for (const Link& link : links(i))
                s.noalias() +=
                    (link.weight * link.rest) * (x[i] - x[static_cast<std::size_t>(link.other)]).transpose();
            rotations[i] = best_rotation(s);
        }
    });
}

void ArapCells::right_side(const std::vector<Mat3>& rotations, Points& b, int threads) const {
    b.resize(size());
    parallel_for(threads, size(), chunk, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            Vec3 sum = Vec3::Zero();
            for (const Link& link : links(i))
                sum += (0.5 * link.weight) *
                       ((rotations[i] + rotations[static_cast<std::size_t>(link.other)]) * link.rest).eval();
            b[i] = sum;
        }
    });
}

} // namespace fascicle::solver
