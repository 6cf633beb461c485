#include "remesh_topology.hpp"

#include "fascicle/base/assert.hpp"

#include <algorithm>
#include <cstdint>

namespace fascicle {

RemeshTopology::RemeshTopology(const TriMesh& mesh)
    : positions(mesh.positions), first_(mesh.positions.size(), -1), triangles_(mesh.triangle_count()) {
    start_.reserve(mesh.triangles.size() * 3);
    struct Side {
        std::int64_t key; // smaller vertex, larger vertex
        int h;
    };
    std::vector<Side> sides;
    sides.reserve(mesh.triangles.size() * 3);
    for (const Tri& t : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int64_t a = t[k], b = t[(k + 1) % 3];
            const int h = half_edges();
            sides.push_back({std::min(a, b) << 32 | std::max(a, b), h});
            start_.push_back(t[k]);
            first_[static_cast<std::size_t>(t[k])] = h;
        }
    std::sort(sides.begin(), sides.end(),
              [](const Side& a, const Side& b) { return a.key != b.key ? a.key < b.key : a.h < b.h; });
    twin_.assign(start_.size(), -1);
    FASCICLE_ASSERT(sides.size() % 2 == 0);
    for (std::size_t i = 0; i < sides.size(); i += 2) {
        FASCICLE_ASSERT(sides[i].key == sides[i + 1].key && start(sides[i].h) != start(sides[i + 1].h));
        FASCICLE_ASSERT(i + 2 == sides.size() || sides[i + 2].key != sides[i].key);
        glue(sides[i].h, sides[i + 1].h);
    }
}

int RemeshTopology::valence(int v) const {
    int count = 0;
    for_edges_from(v, [&](int) { ++count; });
    return count;
}

bool RemeshTopology::has_more_edges(int v, int most) const {
    const int begin = first(v);
    int h = begin, count = 0;
    do {
        if (++count > most)
            return true;
        h = twin(previous(h));
    } while (h != begin);
    return false;
}

bool RemeshTopology::are_joined(int a, int b) const {
    int i = first(a), j = first(b);
    do {
        if (end(i) == b || end(j) == a)
            return true;
        i = twin(previous(i));
        j = twin(previous(j));
    } while (i != first(a) && j != first(b));
    return false;
}

int RemeshTopology::split(int h, const Vec3& p) {
    const int o = twin(h);
    const int hn = next(h), on = next(o);
    const int a = start(h), b = start(o), c = opposite(h), d = opposite(o);
    const int hn_twin = twin(hn), on_twin = twin(on);
    const int m = vertices();
    positions.push_back(p);
    first_.push_back(-1);
    const int n = half_edges();
    start_.insert(start_.end(), {m, b, c, m, a, d}); // new triangles m b c and m a d
    twin_.resize(start_.size(), -1);
    set_start(hn, m); // a b c becomes a m c, b a d becomes b m d
    set_start(on, m);
    glue(n, o);
    glue(n + 1, hn_twin);
    glue(n + 2, hn);
    glue(n + 3, h);
    glue(n + 4, on_twin);
    glue(n + 5, on);
    // Corners that may have lost the half-edge remembered for them.
    first_[static_cast<std::size_t>(a)] = h;
    first_[static_cast<std::size_t>(b)] = o;
    triangles_ += 2;
    return m;
}

bool RemeshTopology::may_flip(int h) const {
    const int c = opposite(h), d = opposite(twin(h));
    return c != d && has_more_edges(start(h), 3) && has_more_edges(end(h), 3) && !are_joined(c, d);
}

void RemeshTopology::flip(int h) {
    const int o = twin(h);
    const int hn = next(h), hp = previous(h), on = next(o), op = previous(o);
    const int a = start(h), b = start(o), c = start(hp), d = start(op);
    const int bc = twin(hn), ca = twin(hp), ad = twin(on), db = twin(op);
    set_start(h, d); // left triangle d c a, right triangle c d b
    set_start(hn, c);
    set_start(hp, a);
    set_start(o, c);
    set_start(on, d);
    set_start(op, b);
    glue(hn, ca);
    glue(hp, ad);
    glue(on, db);
    glue(op, bc);
}

bool RemeshTopology::may_collapse(int h) const {
    const int b = end(h), c = opposite(h), d = opposite(twin(h));
    if (c == d || !has_more_edges(c, 3) || !has_more_edges(d, 3))
        return false;
    int e = h; // the only common neighbours are c and d
    do {
        const int x = end(e);
        if (x != b && x != c && x != d && are_joined(x, b))
            return false;
        e = twin(previous(e));
    } while (e != h);
    return true;
}

void RemeshTopology::collapse(int h, const Vec3& p) {
    const int o = twin(h);
    const int a = start(h), b = end(h), c = opposite(h), d = opposite(o);
    const int bc = twin(next(h)), ca = twin(previous(h)), ad = twin(next(o)), db = twin(previous(o));
    std::vector<int> moved;
    for_edges_from(a, [&](int e) { moved.push_back(e); });
    for (const int e : moved)
        set_start(e, b);
    glue(bc, ca);
    glue(ad, db);
    first_[static_cast<std::size_t>(a)] = -1;
    first_[static_cast<std::size_t>(b)] = ca;
    first_[static_cast<std::size_t>(c)] = bc;
    first_[static_cast<std::size_t>(d)] = ad;
    for (const int gone : {h, o})
        for (const int e : {gone, next(gone), previous(gone)}) {
            start_[static_cast<std::size_t>(e)] = -1;
            twin_[static_cast<std::size_t>(e)] = -1;
        }
    positions[static_cast<std::size_t>(b)] = p;
    triangles_ -= 2;
}

TriMesh RemeshTopology::compact() const {
    TriMesh mesh;
    std::vector<int> number(positions.size(), -1);
    for (int v = 0; v < vertices(); ++v)
        if (is_vertex_alive(v)) {
            number[static_cast<std::size_t>(v)] = mesh.vertex_count();
            mesh.positions.push_back(position(v));
        }
    for (int h = 0; h < half_edges(); h += 3)
        if (is_alive(h))
            mesh.triangles.push_back({number[static_cast<std::size_t>(start(h))],
                                      number[static_cast<std::size_t>(start(h + 1))],
                                      number[static_cast<std::size_t>(start(h + 2))]});
    return mesh;
}

} // namespace fascicle
