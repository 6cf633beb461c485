#include "solver/rivals/lattice_fields.hpp"

#include "fascicle/base/assert.hpp"

#include <algorithm>

namespace fascicle::solver {

namespace {

std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

} // namespace

std::vector<double> node_values(const EmbeddingLattice& lattice, const std::vector<double>& values,
                                std::size_t width, const std::vector<double>& counts, int smoothing) {
    FASCICLE_ASSERT(counts.size() == lattice.bindings.size() && values.size() == counts.size() * width);
    const std::size_t nodes = lattice.nodes.size();
    std::vector<double> sum(nodes * width, 0.0), weight(nodes, 0.0);
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const TetBinding& binding = lattice.bindings[i];
        if (binding.tet < 0 || counts[i] == 0.0)
            continue;
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t node = at(lattice.tets[at(binding.tet)][k]);
            // A node far across the tetrahedron still belongs to it.
            const double w = counts[i] * (std::max(0.0, binding.weights[k]) + 1e-3);
            weight[node] += w;
            for (std::size_t c = 0; c < width; ++c)
                sum[node * width + c] += w * values[i * width + c];
        }
    }
    std::vector<bool> known(nodes, false);
    for (std::size_t n = 0; n < nodes; ++n)
        if (weight[n] > 0.0) {
            known[n] = true;
            for (std::size_t c = 0; c < width; ++c)
                sum[n * width + c] /= weight[n];
        }
    std::vector<double> next(width);
    /// Mean of the known neighbours into next; false: there are none.
    const auto mean = [&](std::size_t n) {
        std::fill(next.begin(), next.end(), 0.0);
        int found = 0;
        for (int j = lattice.neighbour_starts[n]; j < lattice.neighbour_starts[n + 1]; ++j) {
            const std::size_t m = at(lattice.neighbours[at(j)]);
            if (!known[m])
                continue;
            ++found;
            for (std::size_t c = 0; c < width; ++c)
                next[c] += sum[m * width + c];
        }
        for (double& v : next)
            v /= std::max(1, found);
        return found > 0;
    };
    for (bool more = true; more;) {
        std::vector<std::size_t> layer;
        std::vector<double> found;
        for (std::size_t n = 0; n < nodes; ++n)
            if (!known[n] && mean(n)) {
                layer.push_back(n);
                found.insert(found.end(), next.begin(), next.end());
            }
        for (std::size_t l = 0; l < layer.size(); ++l) {
            known[layer[l]] = true;
            std::copy_n(found.begin() + std::ptrdiff_t(l * width), width,
                        sum.begin() + std::ptrdiff_t(layer[l] * width));
        }
        more = !layer.empty();
    }
    for (int round = 0; round < smoothing; ++round) {
        std::vector<double> smooth = sum;
        for (std::size_t n = 0; n < nodes; ++n)
            if (mean(n))
                for (std::size_t c = 0; c < width; ++c)
                    smooth[n * width + c] = 0.5 * (sum[n * width + c] + next[c]);
        sum.swap(smooth);
    }
    return sum;
}

std::vector<int> lattice_parts(const EmbeddingLattice& lattice) {
    std::vector<int> part(lattice.nodes.size(), -1), open;
    int count = 0;
    for (std::size_t first = 0; first < part.size(); ++first) {
        if (part[first] >= 0)
            continue;
        part[first] = count;
        open.assign(1, static_cast<int>(first));
        while (!open.empty()) {
            const std::size_t n = at(open.back());
            open.pop_back();
            for (int j = lattice.neighbour_starts[n]; j < lattice.neighbour_starts[n + 1]; ++j)
                if (int& p = part[at(lattice.neighbours[at(j)])]; p < 0) {
                    p = count;
                    open.push_back(lattice.neighbours[at(j)]);
                }
        }
        ++count;
    }
    return part;
}

} // namespace fascicle::solver
