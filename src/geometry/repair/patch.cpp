// Patches over holes: refined to the density around them and made fair (after Liepa 2003, "Filling holes in meshes": the
// triangulation of least area is refined, its edges flipped to Delaunay's, its vertices put where the surface bends least).
#include "geometry/remesh_topology.hpp"
#include "geometry/repair/steps.hpp"

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

namespace fascicle::detail {

namespace {

class PatchFairer {
public:
    PatchFairer(RepairMesh& m, int first)
        : m_(m), topology_(m.mesh), first_new_(m.mesh.vertex_count()), in_patch_(m.mesh.triangles.size(), 0),
          size_(m.mesh.positions.size(), 0) {
        std::fill(in_patch_.begin() + first, in_patch_.end(), 1);
        measure_sizes(first);
    }

    int run() {
        constexpr int most_passes = 16;
        for (int pass = 0; pass < most_passes; ++pass) {
            const bool split = split_long();
            flip();
            if (!split)
                break;
        }
        const int added = topology_.vertices() - first_new_;
        if (added > 0)
            fair();
        m_.mesh = topology_.compact(); // all vertices are used: numbers stay
        return added;
    }

private:
    bool patch(int h) const { return in_patch_[at(h / 3)] != 0; }
    bool inner(int h) const { return patch(h) && patch(topology_.twin(h)); }

    /// At the border of the patch: mean length of the edges that do not cross it.
    void measure_sizes(int first) {
        for (int h = 3 * first; h < topology_.half_edges(); ++h) {
            const int v = topology_.start(h);
            double sum = 0;
            int count = 0;
            topology_.for_edges_from(v, [&](int e) {
                if (!inner(e)) {
                    sum += topology_.length(e);
                    ++count;
                }
            });
            size_[at(v)] = count > 0 ? sum / count : 0; // 0: between several patches
        }
    }

    bool split_long() {
        bool any = false;
        const int count = topology_.half_edges();
        for (int h = 0; h < count; ++h) {
            if (!inner(h) || h > topology_.twin(h))
                continue;
            const int a = topology_.start(h), b = topology_.end(h);
            const double size = 0.5 * (size_[at(a)] + size_[at(b)]);
            if (!(size > 0) || topology_.length(h) <= 4.0 / 3.0 * size)
                continue;
            topology_.split(h, 0.5 * (topology_.position(a) + topology_.position(b)));
            m_.origins.push_back(mean_origin({m_.origins[at(a)], m_.origins[at(b)]}, {1, 1}));
            size_.push_back(size);
            in_patch_.insert(in_patch_.end(), 2, 1);
            any = true;
        }
        return any;
    }

    double cotangent(int h) const { // of the angle opposite to h
        const Vec3& c = topology_.position(topology_.opposite(h));
        const Vec3 u = topology_.position(topology_.start(h)) - c,
                   v = topology_.position(topology_.end(h)) - c;
        const double sine = u.cross(v).norm();
        return sine > 0 ? u.dot(v) / sine : (u.dot(v) < 0 ? -1e9 : 1e9);
    }

    /// Edges whose opposite angles are more than two right angles together.
    void flip() {
        for (int pass = 0; pass < 8; ++pass) {
            bool any = false;
            for (int h = 0; h < topology_.half_edges(); ++h)
                if (inner(h) && h < topology_.twin(h) &&
                    cotangent(h) + cotangent(topology_.twin(h)) < -1e-9 && topology_.may_flip(h)) {
                    topology_.flip(h);
                    any = true;
                }
            if (!any)
                return;
        }
    }

    /// Least sum, over new vertices and those next to them, of |sum_j w_ij (x_j - x_i) / sum_j w_ij|^2 with w_ij = 1/length.
    void fair() {
        const int n = topology_.vertices() - first_new_;
        std::vector<int> rows;
        std::vector<char> listed(at(topology_.vertices()), 0);
        const auto list = [&](int v) {
            if (!listed[at(v)])
                rows.push_back(v);
            listed[at(v)] = 1;
        };
        for (int v = first_new_; v < topology_.vertices(); ++v) {
            list(v);
            topology_.for_edges_from(v, [&](int h) { list(topology_.end(h)); });
        }
        std::vector<Eigen::Triplet<double>> entries;
        Eigen::MatrixX3d known = Eigen::MatrixX3d::Zero(static_cast<Eigen::Index>(rows.size()), 3);
        for (std::size_t r = 0; r < rows.size(); ++r) {
            const int row = static_cast<int>(r);
            double sum = 0;
            topology_.for_edges_from(rows[r], [&](int h) { sum += weight(h); });
            const auto add = [&](int v, double w) {
                if (v >= first_new_)
                    entries.emplace_back(row, v - first_new_, w);
                else
                    known.row(row) -= w * topology_.position(v).transpose();
            };
            add(rows[r], -1);
            topology_.for_edges_from(rows[r], [&](int h) { add(topology_.end(h), weight(h) / sum); });
        }
        Eigen::SparseMatrix<double> b(static_cast<Eigen::Index>(rows.size()), n);
        b.setFromTriplets(entries.begin(), entries.end());
        const Eigen::SparseMatrix<double> normal = b.transpose() * b;
        const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(normal);
        if (solver.info() != Eigen::Success)
            return;
        const Eigen::MatrixX3d x = solver.solve(Eigen::MatrixX3d(b.transpose() * known));
        if (!x.allFinite())
            return;
        const Points flat(topology_.positions.begin() + first_new_, topology_.positions.end());
        const double before = patch_area();
        for (int v = 0; v < n; ++v)
            topology_.positions[at(first_new_ + v)] = x.row(v).transpose();
        constexpr double most_growth = 3; // a patch that bulges more was drawn out by what is around it
        if (patch_area() > most_growth * before)
            std::copy(flat.begin(), flat.end(), topology_.positions.begin() + first_new_);
    }
    double weight(int h) const { return 1 / std::max(topology_.length(h), 1e-300); }

    double patch_area() const {
        double area = 0;
        for (int h = 0; h < topology_.half_edges(); h += 3)
            if (patch(h)) {
                const Vec3& a = topology_.position(topology_.start(h));
                area += (topology_.position(topology_.end(h)) - a)
                            .cross(topology_.position(topology_.opposite(h)) - a)
                            .norm() /
                        2;
            }
        return area;
    }

    RepairMesh& m_;
    RemeshTopology topology_;
    int first_new_;
    std::vector<char> in_patch_; ///< by triangle
    std::vector<double> size_;   ///< by vertex: wanted length of edges
};

} // namespace

int fair_patches(RepairMesh& m, int first) {
    drop_unused_vertices(m);
    return PatchFairer(m, first).run();
}

} // namespace fascicle::detail
