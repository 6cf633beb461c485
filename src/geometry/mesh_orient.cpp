#include "geometry/mesh_orient.hpp"

#include "fascicle/geometry/bounding_box.hpp"
#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/geometry/volume.hpp"
#include "fascicle/geometry/winding_number.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace fascicle::detail {
namespace {

std::size_t z(int i) {
    return static_cast<std::size_t>(i);
}

void flip(Tri& t) {
    std::swap(t[1], t[2]);
}

/// Triangles connected through edges that have exactly two triangles: their orientations depend on each
/// other.
struct Patches {
    std::vector<int> of_triangle;
    int count = 0;
};

/// Finds the patches and flips the smaller half of each inconsistent one.
Patches make_consistent(TriMesh& mesh, const MeshTopology& topology, OrientationChanges& changes) {
    const std::size_t n = mesh.triangles.size();
    std::vector<int> across(3 * n, -1); // half-edge to the other half-edge of a two-triangle edge
    for (int e = 0; e < static_cast<int>(topology.edges().size()); ++e)
        if (const auto row = topology.edge_half_edges(e); row.size() == 2) {
            across[z(row[0])] = row[1];
            across[z(row[1])] = row[0];
        }
    const auto start_of = [&](int h) { return mesh.triangles[z(h / 3)][z(h % 3)]; };

    Patches patches{std::vector<int>(n, -1), 0};
    std::vector<char> turned(n, 0);
    std::vector<int> queue;
    for (std::size_t seed = 0; seed < n; ++seed) {
        if (patches.of_triangle[seed] >= 0)
            continue;
        const int patch = patches.count++;
        patches.of_triangle[seed] = patch;
        queue.assign(1, static_cast<int>(seed));
        bool orientable = true;
        std::size_t turned_count = 0;
        for (std::size_t head = 0; head < queue.size(); ++head) {
            const int t = queue[head];
            turned_count += turned[z(t)] ? 1 : 0;
            for (int k = 0; k < 3; ++k) {
                const int h = 3 * t + k, other = across[z(h)];
                if (other < 0)
                    continue;
                const bool same_direction = start_of(h) == start_of(other);
                const char wanted = static_cast<char>(same_direction ? !turned[z(t)] : turned[z(t)]);
                const std::size_t u = z(other / 3);
                if (patches.of_triangle[u] < 0) {
                    patches.of_triangle[u] = patch;
                    turned[u] = wanted;
                    queue.push_back(other / 3);
                } else if (turned[u] != wanted) {
                    orientable = false;
                }
            }
        }
        const bool flip_turned = 2 * turned_count <= queue.size();
        for (const int t : queue) {
            const bool minority = (turned[z(t)] != 0) == flip_turned;
            turned[z(t)] = static_cast<char>(orientable && minority);
            changes.inconsistent_triangles += turned[z(t)];
        }
        changes.non_orientable_patches += orientable ? 0 : 1;
    }
    for (std::size_t t = 0; t < n; ++t)
        if (turned[t])
            flip(mesh.triangles[t]);
    return patches;
}

/// Labels for which the triangles of one label do not balance each other at every edge.
std::vector<char> unbalanced_labels(const TriMesh& mesh, const MeshTopology& topology,
                                    const std::vector<int>& label, int label_count) {
    std::vector<char> unbalanced(z(label_count), 0);
    std::vector<std::pair<int, int>> walks; // label, direction
    for (int e = 0; e < static_cast<int>(topology.edges().size()); ++e) {
        // The half-edge ids are those before flipping: find this edge's direction in the triangle as it is now.
        const Edge edge = topology.edges()[z(e)];
        const auto direction = [&](int h) {
            const Tri& t = mesh.triangles[z(h / 3)];
            for (std::size_t k = 0; k < 3; ++k)
                if (t[k] == edge.a && t[(k + 1) % 3] == edge.b)
                    return 1;
            return -1;
        };
        const auto row = topology.edge_half_edges(e);
        if (row.size() == 2) { // nearly all of them
            const int first = label[z(row[0] / 3)], second = label[z(row[1] / 3)];
            if (first != second || direction(row[0]) == direction(row[1]))
                unbalanced[z(first)] = unbalanced[z(second)] = 1;
            continue;
        }
        walks.clear();
        for (const int h : row)
            walks.emplace_back(label[z(h / 3)], direction(h));
        std::sort(walks.begin(), walks.end());
        for (std::size_t i = 0; i < walks.size();) {
            int net = 0;
            const int current = walks[i].first;
            for (; i < walks.size() && walks[i].first == current; ++i)
                net += walks[i].second;
            if (net != 0)
                unbalanced[z(current)] = 1;
        }
    }
    return unbalanced;
}

/// A part that bounds a volume by itself.
struct ClosedPart {
    std::vector<int> triangle_ids;
    std::vector<Tri> triangles;
    double volume = 0.0;
    BoundingBox box;
    std::optional<WindingNumber> winding; ///< made when first asked
    bool flipped = false;
};

std::vector<ClosedPart> closed_parts(const TriMesh& mesh, const MeshTopology& topology,
                                     const Patches& patches) {
    const int patch_count = patches.count, component_count = topology.component_count();
    std::vector<int> component(mesh.triangles.size());
    for (std::size_t t = 0; t < component.size(); ++t)
        component[t] = topology.vertex_component(mesh.triangles[t][0]);
    const auto open_patch = unbalanced_labels(mesh, topology, patches.of_triangle, patch_count);
    const auto open_component = unbalanced_labels(mesh, topology, component, component_count);
    // Where every patch of a component is closed by itself (two bodies sharing an edge), each is a part;
    // where they need each other, the component is.
    std::vector<char> by_patch(z(component_count), 1);
    for (std::size_t t = 0; t < component.size(); ++t)
        if (open_patch[z(patches.of_triangle[t])])
            by_patch[z(component[t])] = 0;

    std::vector<int> part_of(z(patch_count + component_count), -1);
    std::vector<ClosedPart> parts;
    for (std::size_t t = 0; t < component.size(); ++t) {
        const bool use_patch = by_patch[z(component[t])] != 0;
        if (!use_patch && open_component[z(component[t])])
            continue;
        int& part = part_of[z(use_patch ? patches.of_triangle[t] : patch_count + component[t])];
        if (part < 0) {
            part = static_cast<int>(parts.size());
            parts.emplace_back();
        }
        parts[z(part)].triangle_ids.push_back(static_cast<int>(t));
        parts[z(part)].triangles.push_back(mesh.triangles[t]);
    }
    for (ClosedPart& part : parts) {
        part.volume = signed_volume(mesh.positions, part.triangles);
        part.box = bounding_box(mesh.positions, part.triangles);
    }
    return parts;
}

/// Turns outermost parts with negative volume outwards, together with what they enclose; a part with negative
/// volume inside a positive one is a cavity and stays.
void turn_outwards(TriMesh& mesh, std::vector<ClosedPart>& parts, OrientationChanges& changes) {
    if (std::none_of(parts.begin(), parts.end(), [](const ClosedPart& p) { return p.volume < 0.0; }))
        return;
    std::vector<std::size_t> order(parts.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t x, std::size_t y) {
        return std::abs(parts[x].volume) > std::abs(parts[y].volume);
    });
    // A bound on the work for files made of thousands of nested shells: beyond it a part counts as not
    // enclosed.
    int budget = 1'000'000;
    for (std::size_t i = 0; i < order.size(); ++i) {
        ClosedPart& part = parts[order[i]];
        const Tri& t = part.triangles[0];
        const Vec3 probe =
            (mesh.positions[z(t[0])] + mesh.positions[z(t[1])] + mesh.positions[z(t[2])]) / 3.0;
        const ClosedPart* parent = nullptr;
        for (std::size_t j = i; j-- > 0 && parent == nullptr;) {
            ClosedPart& outer = parts[order[j]];
            if (!outer.box.contains(part.box) || budget-- <= 0)
                continue;
            if (!outer.winding)
                outer.winding.emplace(mesh.positions, outer.triangles);
            if (std::abs(outer.winding->fast(probe)) > 0.5)
                parent = &outer;
        }
        part.flipped = parent != nullptr ? parent->flipped : part.volume < 0.0;
        if (part.flipped) {
            ++changes.inverted_components;
            for (const int id : part.triangle_ids)
                flip(mesh.triangles[z(id)]);
        } else if (part.volume < 0.0) {
            ++changes.cavities;
        }
    }
}

} // namespace

OrientationChanges orient(TriMesh& mesh) {
    OrientationChanges changes;
    MeshTopology topology(mesh.vertex_count(), mesh.triangles);
    const Patches patches = make_consistent(mesh, topology, changes);
    std::vector<ClosedPart> parts = closed_parts(mesh, topology, patches);
    turn_outwards(mesh, parts, changes);
    changes.turned =
        changes.inconsistent_triangles > 0 ||
        std::any_of(parts.begin(), parts.end(), [](const ClosedPart& part) { return part.flipped; });
    changes.topology = std::move(topology);
    return changes;
}

} // namespace fascicle::detail
