#include "solver/coarse/coarse_matrix.hpp"

#include "solver/coarse/wide.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace fascicle::solver {

namespace {

std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

Mat3 cross_matrix(const Vec3& v) {
    Mat3 m;
    m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
    return m;
}

/// Sums the pushes of `points` points by their clusters, four each; returns how many clusters there are.
FASCICLE_WIDE int sum_by_cluster(int points, const int* clusters, const float* weights,
                                 const BlockSum::Six* push, int* found, BlockSum::Six* row) {
    int count = 0;
    for (int e = 0; e < 4 * points; ++e) {
        const float w = weights[e];
        if (w == 0.0F)
            continue;
        int place = 0;
        while (place < count && found[place] != clusters[e])
            ++place;
        float* const to = row[place].data();
        const float* const from = push[e / 4].data();
        if (place == count) {
            found[count++] = clusters[e];
            for (int i = 0; i < 8; ++i)
                to[i] = w * from[i];
        } else {
            for (int i = 0; i < 8; ++i)
                to[i] += w * from[i];
        }
    }
    return count;
}

} // namespace

void CoarseMatrix::prepare(const ElasticTerms& terms) {
    const auto sorted = [&](const auto& list, const auto& first_point) {
        std::vector<std::uint64_t> keys; // the two heaviest clusters, the number
        keys.reserve(list.size());
        for (std::size_t i = 0; i < list.size(); ++i) {
            const ClusterWeights& own = basis_.weights()[at(first_point(list[i]))];
            keys.push_back(static_cast<std::uint64_t>(own.cluster[0]) << 48 |
                           static_cast<std::uint64_t>(own.cluster[1]) << 32 | i);
        }
        std::sort(keys.begin(), keys.end());
        std::vector<int> order;
        order.reserve(keys.size());
        for (const std::uint64_t key : keys)
            order.push_back(static_cast<int>(key & 0xffffffffU));
        return order;
    };
    edges_ = sorted(*terms.edges, [](const DistanceConstraint& c) { return c.a; });
    hinges_ = sorted(*terms.hinges, [](const DihedralConstraint& c) { return c.p[2]; });
    const auto members = std::count_if(basis_.weights().begin(), basis_.weights().end(),
                                       [](const ClusterWeights& w) { return w.weight[0] > 0.0; });
    edge_stride_ = double(members) > many_members * basis_.clusters() ? 2 : 1;
    hinge_stride_ = 2 * edge_stride_;
    find_pattern(terms);
    for (std::size_t p = 0; p < parts; ++p) {
        sums_[p].reset(pattern_);
        moments_[p].assign(pattern_.pairs().size(), PairMoments{});
    }
    factor_.reset(basis_.unknowns(), std::min(basis_.band(), basis_.unknowns() - 1));
}

/// The clusters of one term's points may all meet.
void CoarseMatrix::find_pattern(const ElasticTerms& terms) {
    const int width = basis_.band() / 6 + 1;
    std::vector<char> meet(at(basis_.clusters()) * at(width), 0);
    const auto add = [&](int p, int q) {
        const ClusterWeights &own = basis_.weights()[at(p)], &other = basis_.weights()[at(q)];
        for (std::size_t k = 0; k < 4; ++k)
            for (std::size_t l = 0; l < 4; ++l)
                if (own.weight[k] != 0.0 && other.weight[l] != 0.0) {
                    const auto [b, a] = std::minmax(own.cluster[k], other.cluster[l]);
                    meet[at(b * width + a - b)] = 1;
                }
    };
    for (const DistanceConstraint& edge : *terms.edges)
        add(edge.a, edge.b);
    for (const DihedralConstraint& hinge : *terms.hinges)
        add(hinge.p[0], hinge.p[1]); // the other pairs are edges
    for (std::size_t i = 0; i < basis_.weights().size(); ++i)
        add(static_cast<int>(i), static_cast<int>(i));
    std::vector<std::pair<int, int>> pairs;
    for (int b = 0; b < basis_.clusters(); ++b)
        for (int d = 0; d < width; ++d)
            if (meet[at(b * width + d)] != 0)
                pairs.emplace_back(b + d, b);
    pattern_ = BlockPattern(basis_.clusters(), width, std::move(pairs));
}

void CoarseMatrix::begin(const Points& x, const ElasticTerms& terms) {
    if (edges_.size() != terms.edges->size() || hinges_.size() != terms.hinges->size())
        prepare(terms);
    basis_.set_reference(x);
    for (BlockSum& sum : sums_)
        sum.reset(pattern_);
}

/// Adds weight P^T grad C grad C^T P. The row of P^T grad C: the clusters of the term's points with six entries each; in
/// the frames of the moment when the matrix is made nothing is turned. Moments are formed about the first point.
void CoarseMatrix::add(BlockSum& sum, const Points& x, const ElasticTerm& term, double weight) const {
    std::array<int, 16> cluster, clusters;
    std::array<float, 16> weights;
    std::array<BlockSum::Six, 16> row;
    std::array<BlockSum::Six, 4> push;
    const double scale = std::sqrt(weight), per_radius = 1.0 / basis_.radius();
    const Vec3 origin = x[at(term.point[0])];
    for (std::size_t j = 0; j < at(term.count); ++j) {
        const ClusterWeights& own = basis_.weights()[at(term.point[j])];
        const Vec3 force = scale * term.gradient[j];
        const Vec3 torque = per_radius * (x[at(term.point[j])] - origin).cross(force);
        push[j] = {static_cast<float>(force.x()),  static_cast<float>(force.y()),
                   static_cast<float>(force.z()),  static_cast<float>(torque.x()),
                   static_cast<float>(torque.y()), static_cast<float>(torque.z())};
        for (std::size_t k = 0; k < 4; ++k) {
            clusters[4 * j + k] = own.cluster[k];
            weights[4 * j + k] = own.weight[k];
        }
    }
    const int count =
        sum_by_cluster(term.count, clusters.data(), weights.data(), push.data(), cluster.data(), row.data());
    for (std::size_t k = 0; k < at(count); ++k) {
        BlockSum::Six& r = row[k];
        const Vec3 arm = per_radius * (origin - basis_.centre(cluster[k]));
        const auto x0 = static_cast<float>(arm.x()), y0 = static_cast<float>(arm.y()),
                   z0 = static_cast<float>(arm.z());
        r[3] += y0 * r[2] - z0 * r[1];
        r[4] += z0 * r[0] - x0 * r[2];
        r[5] += x0 * r[1] - y0 * r[0];
    }
    sum.add_outer(pattern_, cluster.data(), row.data(), count);
}

/// P^T P from the moments of each pair of clusters: with J = (1, -[r]x / R), r from the cluster's centre,
/// J_a^T J_b = (1, -[r_b]x / R; [r_a]x / R, ((r_a . r_b) 1 - r_b r_a^T) / R^2).
void CoarseMatrix::add_inertia(std::size_t part, const Points& x, std::size_t first, std::size_t end) {
    std::vector<PairMoments>& moments = moments_[part];
    moments.assign(pattern_.pairs().size(), PairMoments{});
    for (std::size_t i = first; i < end; ++i) {
        const ClusterWeights& own = basis_.weights()[i];
        for (std::size_t l = 0; l < 4; ++l) {
            if (own.weight[l] == 0.0)
                continue;
            const Vec3 p = x[i] - basis_.centre(own.cluster[l]), q = double(own.weight[l]) * p;
            const PairMoments some{double(own.weight[l]), q.x(),         q.y(),         q.z(),
                                   p.x() * q.x(),         p.x() * q.y(), p.x() * q.z(), p.y() * q.y(),
                                   p.y() * q.z(),         p.z() * q.z()};
            for (std::size_t k = 0; k < 4; ++k) {
                const auto w = static_cast<double>(own.weight[k]);
                if (w == 0.0 || own.cluster[k] < own.cluster[l])
                    continue;
                PairMoments& pair = moments[at(pattern_.place(own.cluster[k], own.cluster[l]))];
                for (std::size_t c = 0; c < some.size(); ++c)
                    pair[c] += w * some[c];
            }
        }
    }
    const double per_radius = 1.0 / basis_.radius();
    for (std::size_t n = 0; n < moments.size(); ++n) {
        const PairMoments& pair = moments[n];
        if (pair[0] == 0.0)
            continue;
        const auto [a, b] = pattern_.pairs()[n];
        const Vec3 d = basis_.centre(b) - basis_.centre(a), first_moment(pair[1], pair[2], pair[3]);
        Mat3 second;
        second << pair[4], pair[5], pair[6], pair[5], pair[7], pair[8], pair[6], pair[8], pair[9];
        Eigen::Matrix<double, 6, 6> block;
        block.topLeftCorner<3, 3>() = pair[0] * Mat3::Identity();
        block.topRightCorner<3, 3>() = -per_radius * cross_matrix(first_moment);
        block.bottomLeftCorner<3, 3>() = per_radius * cross_matrix(first_moment + pair[0] * d);
        block.bottomRightCorner<3, 3>() = per_radius * per_radius *
                                          ((second.trace() + d.dot(first_moment)) * Mat3::Identity() -
                                           second - first_moment * d.transpose());
        BlockSum::Block& sum = sums_[part].block(static_cast<int>(n));
        for (int j = 0; j < 6; ++j)
            for (int i = 0; i < 6; ++i)
                sum.v[at(8 * j + i)] += static_cast<float>(block(i, j));
    }
}

void CoarseMatrix::add_part(std::size_t part, const Points& x, const ElasticTerms& terms,
                            const std::vector<double>& inverse_mass, const Points& normals) {
    BlockSum& sum = sums_[part];
    const auto share = [&](std::size_t count, std::size_t p) { return count * p / parts; };
    ElasticTerm term;
    const TermSample some_edges{assemblies_ % edge_stride_, edge_stride_};
    for (std::size_t i = share(edges_.size(), part); i < share(edges_.size(), part + 1); ++i) {
        if (!some_edges.has(at(edges_[i])))
            continue;
        edge_term(terms, x, at(edges_[i]), term);
        add(sum, x, term, matrix_safety * edge_stride_ * term.weight);
    }
    const TermSample some_hinges{assemblies_ % hinge_stride_, hinge_stride_};
    for (std::size_t i = share(hinges_.size(), part); i < share(hinges_.size(), part + 1); ++i)
        if (some_hinges.has(at(hinges_[i])) && hinge_term(terms, x, at(hinges_[i]), term))
            add(sum, x, term, matrix_safety * hinge_stride_ * term.weight);
    // Vertices, in their own order.
    const std::size_t first = x.size() * part / parts, end = x.size() * (part + 1) / parts;
    add_inertia(part, x, first, end);
    // Contacts are as stiff as an edge.
    const double contact =
        2.0 * terms.share * terms.substep_s * terms.substep_s / compliance_from_stiffness(0.9, 2.0);
    ElasticTerm one;
    one.count = 1;
    for (std::size_t i = first; i < end && !normals.empty(); ++i)
        if (inverse_mass[i] != 0.0 && !normals[i].isZero(0.0)) {
            one.point[0] = static_cast<int>(i);
            one.gradient[0] = normals[i];
            add(sum, x, one, contact);
        }
}

void CoarseMatrix::finish() {
    factor_.reset(basis_.unknowns(), std::min(basis_.band(), basis_.unknowns() - 1));
    for (std::size_t n = 0; n < pattern_.pairs().size(); ++n) {
        const auto [a, b] = pattern_.pairs()[n];
        for (int j = 0; j < 6; ++j)
            for (int i = a == b ? j : 0; i < 6; ++i) {
                float sum = 0;
                for (const BlockSum& part : sums_)
                    sum += part.block(static_cast<int>(n)).v[at(8 * j + i)];
                factor_.at(6 * a + i, 6 * b + j) = sum;
            }
    }
    for (int i = 0; i < basis_.unknowns(); ++i)
        factor_.at(i, i) += 1e-6F * factor_.at(i, i) + 1e-6F;
    factor_.factor();
    ++assemblies_;
}

void CoarseMatrix::assemble(const Points& x, const ElasticTerms& terms,
                            const std::vector<double>& inverse_mass, const Points& normals) {
    begin(x, terms);
    for (std::size_t p = 0; p < parts; ++p)
        add_part(p, x, terms, inverse_mass, normals);
    finish();
}

} // namespace fascicle::solver
