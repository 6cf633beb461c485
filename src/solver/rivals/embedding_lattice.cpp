#include "solver/rivals/embedding_lattice.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/base/parallel.hpp"
#include "fascicle/geometry/bounding_box.hpp"
#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/geometry/volume.hpp"
#include "fascicle/geometry/winding_number.hpp"
#include "solver/rivals/tet_overlap.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::solver {

namespace {

using Index3 = std::array<int, 3>;

/// The cells of the lattice and their tetrahedra. Four of them lie about the line from a cell's centre to that of the next cell along an
/// axis: the two centres and an edge of the square between the cells. Slot 12 cell + 4 axis + k.
class Cells {
public:
    Cells(const BoundingBox& box, double spacing) : spacing_(spacing), low_(box.min) {
        for (std::size_t d = 0; d < 3; ++d) {
            const double cells = box.size()[static_cast<int>(d)] / spacing;
            // One more cell on either side: tetrahedra reach from centre to centre.
            count_[d] = static_cast<int>(std::floor(cells)) + 3;
        }
        low_ -= Vec3::Constant(spacing);
    }
    std::size_t size() const {
        return std::size_t(count_[0]) * std::size_t(count_[1]) * std::size_t(count_[2]);
    }
    static double cells_of(const BoundingBox& box, double spacing) {
        return (box.size() / spacing + Vec3::Constant(3)).prod();
    }
    std::size_t slots() const { return 12 * size(); }
    Index3 cell_of(std::size_t cell) const {
        const auto nx = std::size_t(count_[0]), ny = std::size_t(count_[1]);
        return {int(cell % nx), int(cell / nx % ny), int(cell / (nx * ny))};
    }
    std::size_t number(const Index3& c) const {
        return std::size_t(c[0]) +
               std::size_t(count_[0]) * (std::size_t(c[1]) + std::size_t(count_[1]) * std::size_t(c[2]));
    }
    Vec3 centre(const Index3& c) const { return low_ + spacing_ * Vec3(c[0] + 0.5, c[1] + 0.5, c[2] + 0.5); }
    Vec3 corner(const Index3& c) const { return low_ + spacing_ * Vec3(c[0], c[1], c[2]); }
    /// Whether the slot has a second cell.
    bool exists(std::size_t slot) const {
        const Index3 c = cell_of(slot / 12);
        const std::size_t axis = slot % 12 / 4;
        return c[axis] + 1 < count_[axis];
    }
    /// Lattice points of a tetrahedron: centres as 2 number, corners (which need one more along each axis) as 2 number + 1 of a grid
    /// that is one larger.
    std::array<std::uint64_t, 4> keys(std::size_t slot) const {
        const Index3 c = cell_of(slot / 12);
        const std::size_t axis = slot % 12 / 4, k = slot % 4;
        Index3 next = c;
        ++next[axis];
        const auto ring = [&](std::size_t j) {
            Index3 q = next;
            q[(axis + 1) % 3] += j == 1 || j == 2 ? 1 : 0;
            q[(axis + 2) % 3] += j == 2 || j == 3 ? 1 : 0;
            return 2 * corner_number(q) + 1;
        };
        // Counter-clockwise about the axis: positive volume in this order.
        return {2 * number(c), 2 * number(next), ring(k), ring((k + 1) % 4)};
    }
    Vec3 point(std::uint64_t key) const {
        if (key % 2 == 0)
            return centre(cell_of(key / 2));
        const auto n = key / 2, nx = std::uint64_t(count_[0]) + 1, ny = std::uint64_t(count_[1]) + 1;
        return corner({int(n % nx), int(n / nx % ny), int(n / (nx * ny))});
    }
    TetCorners corners(std::size_t slot) const {
        const auto k = keys(slot);
        return {point(k[0]), point(k[1]), point(k[2]), point(k[3])};
    }
    /// Calls body(slot) for every tetrahedron that may meet the box.
    template <class Body>
    void near(const BoundingBox& box, const Body& body) const {
        Index3 from, to;
        for (int d = 0; d < 3; ++d) {
            const auto at = static_cast<std::size_t>(d);
            from[at] =
                std::clamp(int(std::floor((box.min[d] - low_[d]) / spacing_ - 1e-9)) - 1, 0, count_[at] - 1);
            to[at] = std::clamp(int(std::floor((box.max[d] - low_[d]) / spacing_ + 1e-9)), 0, count_[at] - 1);
        }
        Index3 c;
        for (c[2] = from[2]; c[2] <= to[2]; ++c[2])
            for (c[1] = from[1]; c[1] <= to[1]; ++c[1])
                for (c[0] = from[0]; c[0] <= to[0]; ++c[0])
                    for (std::size_t t = 0; t < 12; ++t)
                        if (const std::size_t slot = 12 * number(c) + t; exists(slot))
                            body(slot);
    }

private:
    std::uint64_t corner_number(const Index3& c) const {
        const auto nx = std::uint64_t(count_[0]) + 1, ny = std::uint64_t(count_[1]) + 1;
        return std::uint64_t(c[0]) + nx * (std::uint64_t(c[1]) + ny * std::uint64_t(c[2]));
    }

    double spacing_;
    Vec3 low_;
    Index3 count_{};
};

enum : std::uint8_t { outside = 0, cut = 1, inside = 2 };

BoundingBox box_of(const std::array<Vec3, 3>& triangle) {
    BoundingBox box;
    for (const Vec3& p : triangle)
        box.add(p);
    return box;
}

/// State of every slot. A tetrahedron that no triangle touches is inside or outside as a whole, as its first centre is.
std::vector<std::uint8_t> classify(const Cells& cells, const TriMesh& surface, const WindingNumber& winding,
                                   int threads) {
    std::vector<std::uint8_t> state(cells.slots(), outside);
    for (const Tri& t : surface.triangles) {
        if (has_repeated_index(t))
            continue;
        std::array<Vec3, 3> corners;
        for (std::size_t i = 0; i < 3; ++i)
            corners[i] = surface.positions[static_cast<std::size_t>(t[i])];
        cells.near(box_of(corners), [&](std::size_t slot) {
            if (state[slot] != cut && triangle_meets_tet(corners, cells.corners(slot)))
                state[slot] = cut;
        });
    }
    parallel_for(threads, cells.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c) {
            const auto first = state.begin() + std::ptrdiff_t(12 * c);
            if (std::all_of(first, first + 12, [](std::uint8_t s) { return s == cut; }) ||
                !winding.inside(cells.centre(cells.cell_of(c))))
                continue;
            for (std::size_t slot = 12 * c; slot < 12 * c + 12; ++slot)
                if (state[slot] == outside && cells.exists(slot))
                    state[slot] = inside;
        }
    });
    return state;
}

/// Share of 20 evenly spread points that lie inside.
double fill_of(const TetCorners& corners, const WindingNumber& winding) {
    int found = 0, all = 0;
    for (int a = 0; a < 4; ++a)
        for (int b = 0; a + b < 4; ++b)
            for (int c = 0; a + b + c < 4; ++c, ++all) {
                const int d = 3 - a - b - c;
                const Vec3 p = ((a + 0.25) * corners[0] + (b + 0.25) * corners[1] + (c + 0.25) * corners[2] +
                                (d + 0.25) * corners[3]) /
                               4.0;
                found += winding.inside(p) ? 1 : 0;
            }
    return std::max(least_fill, double(found) / all);
}

TetBinding binding_of(const Cells& cells, const std::vector<int>& tet_of_slot, const Vec3& p) {
    TetBinding best;
    double best_least = -1e-6; // what rounding may leave it outside by
    BoundingBox box;
    box.add(p);
    cells.near(box, [&](std::size_t slot) {
        if (tet_of_slot[slot] < 0)
            return;
        const auto weights = tet_weights(p, cells.corners(slot));
        const double least = *std::min_element(weights.begin(), weights.end());
        if (least > best_least) {
            best_least = least;
            best = {tet_of_slot[slot], weights};
        }
    });
    return best;
}

void find_neighbours(EmbeddingLattice& lattice) {
    std::vector<std::vector<int>> rows(lattice.nodes.size());
    for (const Tet& tet : lattice.tets)
        for (const int a : tet)
            for (const int b : tet)
                if (a != b)
                    rows[static_cast<std::size_t>(a)].push_back(b);
    lattice.neighbour_starts.assign(1, 0);
    for (auto& row : rows) {
        std::sort(row.begin(), row.end());
        row.erase(std::unique(row.begin(), row.end()), row.end());
        lattice.neighbours.insert(lattice.neighbours.end(), row.begin(), row.end());
        lattice.neighbour_starts.push_back(static_cast<int>(lattice.neighbours.size()));
    }
}

} // namespace

Vec3 EmbeddingLattice::bound_point(std::size_t i, const Points& x) const {
    const TetBinding& binding = bindings[i];
    const Tet& tet = tets[static_cast<std::size_t>(binding.tet)];
    Vec3 p = Vec3::Zero();
    for (std::size_t k = 0; k < 4; ++k)
        p += binding.weights[k] * x[static_cast<std::size_t>(tet[k])];
    return p;
}

EmbeddingLattice make_embedding_lattice(const TriMesh& surface, const LatticeOptions& options) {
    FASCICLE_ASSERT(options.spacing > 0.0 && options.most_tets >= 1000);
    const BoundingBox box = bounding_box(surface.positions, surface.triangles);
    if (!(box.diagonal() > 0.0))
        throw_error("embedding lattice", "the surface has no extent", "a closed surface around some volume");
    const WindingNumber winding(surface);
    constexpr double most_cells = 5e5, coarser = 1.1;
    double spacing = std::min(options.spacing, box.diagonal() / 6.0);
    // The volume alone needs so many; less need not be tried (but for rounding, and for surfaces that overlap themselves).
    const double volume = std::abs(signed_volume(surface.positions, surface.triangles));
    while (volume / (spacing * spacing * spacing / 12.0) > 1.2 * options.most_tets)
        spacing *= coarser;
    for (;; spacing *= coarser) {
        if (Cells::cells_of(box, spacing) > most_cells)
            continue;
        const Cells cells(box, spacing);
        const auto state = classify(cells, surface, winding, options.threads);
        const auto kept =
            std::count_if(state.begin(), state.end(), [](std::uint8_t s) { return s != outside; });
        if (kept > options.most_tets)
            continue;
        EmbeddingLattice lattice;
        lattice.spacing = spacing;
        std::vector<int> tet_of_slot(cells.slots(), -1);
        std::vector<std::size_t> slots;
        std::vector<std::uint64_t> keys;
        for (std::size_t slot = 0; slot < state.size(); ++slot)
            if (state[slot] != outside) {
                tet_of_slot[slot] = static_cast<int>(slots.size());
                slots.push_back(slot);
                for (const std::uint64_t key : cells.keys(slot))
                    keys.push_back(key);
            }
        std::vector<std::uint64_t> nodes = keys;
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        for (const std::uint64_t key : nodes)
            lattice.nodes.push_back(cells.point(key));
        lattice.tets.resize(slots.size());
        lattice.fill.assign(slots.size(), 1.0);
        parallel_for(options.threads, slots.size(), 64, [&](std::size_t begin, std::size_t end) {
            for (std::size_t t = begin; t < end; ++t) {
                for (std::size_t k = 0; k < 4; ++k)
                    lattice.tets[t][k] = static_cast<int>(
                        std::lower_bound(nodes.begin(), nodes.end(), keys[4 * t + k]) - nodes.begin());
                if (state[slots[t]] == cut)
                    lattice.fill[t] = fill_of(cells.corners(slots[t]), winding);
            }
        });
        lattice.bindings.resize(surface.positions.size());
        std::vector<bool> used(surface.positions.size(), false);
        for (const Tri& t : surface.triangles)
            if (!has_repeated_index(t))
                for (const int v : t)
                    used[static_cast<std::size_t>(v)] = true;
        for (std::size_t i = 0; i < used.size(); ++i)
            if (used[i]) {
                lattice.bindings[i] = binding_of(cells, tet_of_slot, surface.positions[i]);
                FASCICLE_ASSERT(lattice.bindings[i].tet >= 0);
            }
        find_neighbours(lattice);
        return lattice;
    }
}

} // namespace fascicle::solver
