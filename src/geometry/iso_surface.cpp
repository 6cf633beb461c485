#include "fascicle/geometry/iso_surface.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/base/parallel.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

namespace fascicle {

namespace {

/// Corner c of a cell has offsets (c & 1, c >> 1 & 1, c >> 2). Each tetrahedron walks 000 -> 111 along the
/// axes in one of the six orders; odd orders have their middle corners swapped, so that all are positively
/// oriented.
constexpr std::array<std::array<int, 4>, 6> tetrahedra{
    {{0, 1, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}, {0, 3, 2, 7}, {0, 6, 4, 7}}};
/// Even orders of the corners of a tetrahedron that bring corner i to the front, or the pair (i, j).
constexpr std::array<std::array<int, 4>, 4> lone{{{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 3, 0, 1}, {3, 2, 1, 0}}};
constexpr std::array<std::array<int, 4>, 6> pairs{
    {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}}};

class Extractor {
public:
    explicit Extractor(const ImplicitField& field) : field_(field) {
        const std::size_t layer =
            static_cast<std::size_t>(field.nodes()[0]) * static_cast<std::size_t>(field.nodes()[1]) * 8;
        for (auto& l : layers_)
            l.assign(layer, -1);
    }

    TriMesh run() {
        const auto& n = field_.nodes();
        for (int k = 0; k + 1 < n[2]; ++k) {
            for (int j = 0; j + 1 < n[1]; ++j)
                for (int i = 0; i + 1 < n[0]; ++i)
                    cell(i, j, k);
            std::swap(layers_[0], layers_[1]);
            std::fill(layers_[1].begin(), layers_[1].end(), -1);
        }
        return std::move(mesh_);
    }

private:
    void cell(int i, int j, int k) {
        at_ = {i, j, k};
        unsigned inside = 0;
        for (int c = 0; c < 8; ++c) {
            const auto u = static_cast<std::size_t>(c);
            value_[u] = field_.at(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2));
            inside |= static_cast<unsigned>(value_[u] < 0.0) << c;
        }
        if (inside == 0 || inside == 255)
            return;
        for (const auto& tet : tetrahedra)
            tetrahedron(tet);
    }

    void tetrahedron(const std::array<int, 4>& tet) {
        unsigned mask = 0;
        for (std::size_t c = 0; c < 4; ++c)
            mask |= static_cast<unsigned>(value_[static_cast<std::size_t>(tet[c])] < 0.0) << c;
        const auto vertex = [&](const std::array<int, 4>& order, std::size_t a, std::size_t b) {
            return edge_vertex(tet[static_cast<std::size_t>(order[a])],
                               tet[static_cast<std::size_t>(order[b])]);
        };
        for (std::size_t c = 0; c < 4; ++c) {
            if (mask == 1U << c)
                mesh_.triangles.push_back(
                    {vertex(lone[c], 0, 1), vertex(lone[c], 0, 2), vertex(lone[c], 0, 3)});
            if (mask == (15U ^ (1U << c)))
                mesh_.triangles.push_back(
                    {vertex(lone[c], 0, 1), vertex(lone[c], 0, 3), vertex(lone[c], 0, 2)});
        }
        for (const auto& p : pairs)
            if (mask == ((1U << p[0]) | (1U << p[1]))) {
                const int a = vertex(p, 0, 2), b = vertex(p, 0, 3), c = vertex(p, 1, 3), d = vertex(p, 1, 2);
                mesh_.triangles.push_back({a, b, c});
                mesh_.triangles.push_back({a, c, d});
            }
    }

    /// The vertex on the edge between two corners of the cell, made at first use. An edge belongs to its
    /// lower corner; the difference of the corners (1 to 7) says which of that node's edges it is.
    int edge_vertex(int a, int b) {
        const int low = std::min(a, b), high = std::max(a, b); // a corner's bits are a subset of the other's
        const std::size_t node =
            static_cast<std::size_t>(at_[1] + (low >> 1 & 1)) * static_cast<std::size_t>(field_.nodes()[0]) +
            static_cast<std::size_t>(at_[0] + (low & 1));
        int& slot =
            layers_[static_cast<std::size_t>(low >> 2)][node * 8 + static_cast<std::size_t>(high - low)];
        if (slot < 0) {
            slot = mesh_.vertex_count();
            const double fa = value_[static_cast<std::size_t>(low)],
                         fb = value_[static_cast<std::size_t>(high)];
            const double t = std::clamp(fa / (fa - fb), 0.05, 0.95);
            mesh_.positions.push_back((1.0 - t) * corner(low) + t * corner(high));
        }
        return slot;
    }

    Vec3 corner(int c) const {
        return field_.position(at_[0] + (c & 1), at_[1] + (c >> 1 & 1), at_[2] + (c >> 2));
    }

    const ImplicitField& field_;
    std::array<std::vector<int>, 2> layers_; // vertex of each edge of the nodes of two layers of the grid
    std::array<int, 3> at_{};
    std::array<double, 8> value_{};
    TriMesh mesh_;
};

} // namespace

TriMesh extract_iso_surface(const ImplicitField& field) {
    return Extractor(field).run();
}

TriMesh largest_component(const TriMesh& mesh) {
    std::vector<int> parent(mesh.positions.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](int v) {
        while (parent[static_cast<std::size_t>(v)] != v) {
            int& p = parent[static_cast<std::size_t>(v)];
            p = parent[static_cast<std::size_t>(p)];
            v = p;
        }
        return v;
    };
    for (const Tri& t : mesh.triangles)
        for (const int v : {t[1], t[2]}) {
            const int a = root(t[0]), b = root(v);
            parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
        }
    std::vector<int> size(mesh.positions.size(), 0);
    for (const Tri& t : mesh.triangles)
        ++size[static_cast<std::size_t>(root(t[0]))];
    TriMesh part;
    if (mesh.triangles.empty())
        return part;
    const int kept = static_cast<int>(std::max_element(size.begin(), size.end()) - size.begin());
    std::vector<int> number(mesh.positions.size(), -1);
    for (int v = 0; v < mesh.vertex_count(); ++v)
        if (root(v) == kept) {
            number[static_cast<std::size_t>(v)] = part.vertex_count();
            part.positions.push_back(mesh.positions[static_cast<std::size_t>(v)]);
        }
    for (const Tri& t : mesh.triangles)
        if (root(t[0]) == kept)
            part.triangles.push_back({number[static_cast<std::size_t>(t[0])],
                                      number[static_cast<std::size_t>(t[1])],
                                      number[static_cast<std::size_t>(t[2])]});
    return part;
}

TriMesh mesh_implicit(const Implicit& f, const ImplicitField& field, const ImplicitMeshOptions& options) {
    const TriMesh rough = largest_component(extract_iso_surface(field));
    if (rough.triangles.empty())
        throw_error("implicit mesh", "the solid has no inside in its box",
                    "a solid larger than the grid spacing");
    const double step = 0.5 * field.spacing();
    const auto move_onto = [step](const Vec3& p, double value, const Vec3& gradient) {
        const double squared = gradient.squaredNorm();
        if (!(squared > 1e-4))
            return p;
        const Vec3 shift = -value / squared * gradient;
        const double length = shift.norm();
        return Vec3(p + (length > step ? step / length : 1.0) * shift);
    };
    RemeshOptions remeshing;
    remeshing.triangles = options.triangles;
    remeshing.rounds = options.rounds;
    remeshing.project = [&](const Vec3& p) { return move_onto(p, field(p), field.gradient(p)); };
    TriMesh mesh = remesh(rough, remeshing);
    const double h = 1e-3 * field.spacing();
    parallel_for(options.threads, mesh.positions.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v)
            for (int pass = 0; pass < 2; ++pass) {
                Vec3& p = mesh.positions[v];
                p = move_onto(p, f(p), implicit_gradient(f, p, h));
            }
    });
    return mesh;
}

} // namespace fascicle
