#include "solver/coarse/coarse_matrix.hpp"

#include "solver/coarse/coarse_step.hpp"
#include "solver/coarse/wide.hpp"

#include <algorithm>
#include <cmath>

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
                                 const BandedCholesky::Six* push, int* found, BandedCholesky::Six* row) {
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

void CoarseMatrix::sort_terms(const ElasticTerms& terms) {
    const auto sorted = [&](const auto& list, const auto& first_point) {
        std::vector<std::array<int, 5>> keys;
        for (std::size_t i = 0; i < list.size(); ++i) {
            const ClusterWeights& own = basis_.weights()[at(first_point(list[i]))];
            std::array<int, 4> clusters = own.cluster;
            std::sort(clusters.begin(), clusters.end());
            keys.push_back({clusters[0], clusters[1], clusters[2], clusters[3], static_cast<int>(i)});
        }
        std::sort(keys.begin(), keys.end());
        std::vector<int> order;
        order.reserve(keys.size());
        for (const auto& key : keys)
            order.push_back(key[4]);
        return order;
    };
    edges_ = sorted(*terms.edges, [](const DistanceConstraint& c) { return c.a; });
    hinges_ = sorted(*terms.hinges, [](const DihedralConstraint& c) { return c.p[2]; });
    const auto members = std::count_if(basis_.weights().begin(), basis_.weights().end(),
                                       [](const ClusterWeights& w) { return w.weight[0] > 0.0; });
    edge_stride_ = double(members) > many_members * basis_.clusters() ? 2 : 1;
    hinge_stride_ = 2 * edge_stride_;
}

void CoarseMatrix::begin(const Points& x, const ElasticTerms& terms) {
    if (edges_.size() != terms.edges->size() || hinges_.size() != terms.hinges->size())
        sort_terms(terms);
    basis_.set_reference(x);
    for (BandedCholesky& sum : sums_)
        sum.reset(basis_.unknowns(), std::min(basis_.band(), basis_.unknowns() - 1));
}

/// Adds weight P^T grad C grad C^T P. The row of P^T grad C: the clusters of the term's points with six entries each; in
/// the frames of the moment when the matrix is made nothing is turned. Moments are formed about the first point.
void CoarseMatrix::add(BandedCholesky& sum, const Points& x, const ElasticTerm& term, double weight) const {
    std::array<int, 16> cluster, clusters;
    std::array<float, 16> weights;
    std::array<BandedCholesky::Six, 16> row;
    std::array<BandedCholesky::Six, 4> push;
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
            weights[4 * j + k] = static_cast<float>(own.weight[k]);
        }
    }
    const int count =
        sum_by_cluster(term.count, clusters.data(), weights.data(), push.data(), cluster.data(), row.data());
    for (std::size_t k = 0; k < at(count); ++k) {
        BandedCholesky::Six& r = row[k];
        const Vec3 arm = per_radius * (origin - basis_.centre(cluster[k]));
        const auto x0 = static_cast<float>(arm.x()), y0 = static_cast<float>(arm.y()),
                   z0 = static_cast<float>(arm.z());
        r[3] += y0 * r[2] - z0 * r[1];
        r[4] += z0 * r[0] - x0 * r[2];
        r[5] += x0 * r[1] - y0 * r[0];
    }
    sum.add_outer(cluster.data(), row.data(), count);
}

/// P^T P from the moments of each pair of clusters: with J = (1, -[r]x / R), r from the cluster's centre,
/// J_a^T J_b = (1, -[r_b]x / R; [r_a]x / R, ((r_a . r_b) 1 - r_b r_a^T) / R^2).
void CoarseMatrix::add_inertia(std::size_t part, const Points& x, std::size_t first, std::size_t end) {
    BandedCholesky& sum = sums_[part];
    std::vector<PairMoments>& pairs = pairs_[part];
    const std::size_t width = at(sum.band()) / 6 + 1;
    pairs.assign(at(basis_.clusters()) * width, PairMoments{});
    for (std::size_t i = first; i < end; ++i) {
        const ClusterWeights& own = basis_.weights()[i];
        for (std::size_t k = 0; k < 4; ++k)
            for (std::size_t l = 0; l < 4; ++l) {
                const double w = own.weight[k] * own.weight[l];
                if (w == 0.0 || own.cluster[k] < own.cluster[l])
                    continue;
                const Vec3 p = x[i] - basis_.centre(own.cluster[l]);
                PairMoments& pair = pairs[at(own.cluster[l]) * width + at(own.cluster[k] - own.cluster[l])];
                pair.zeroth += w;
                pair.first += w * p;
                pair.second += w * p * p.transpose();
            }
    }
    const double per_radius = 1.0 / basis_.radius();
    for (int b = 0; b < basis_.clusters(); ++b)
        for (int a = b; a < std::min(basis_.clusters(), b + static_cast<int>(width)); ++a) {
            const PairMoments& pair = pairs[at(b) * width + at(a - b)];
            if (pair.zeroth == 0.0)
                continue;
            const Vec3 d = basis_.centre(b) - basis_.centre(a);
            Eigen::Matrix<double, 6, 6> block;
            block.topLeftCorner<3, 3>() = pair.zeroth * Mat3::Identity();
            block.topRightCorner<3, 3>() = -per_radius * cross_matrix(pair.first);
            block.bottomLeftCorner<3, 3>() = per_radius * cross_matrix(pair.first + pair.zeroth * d);
            block.bottomRightCorner<3, 3>() = per_radius * per_radius *
                                              ((pair.second.trace() + d.dot(pair.first)) * Mat3::Identity() -
                                               pair.second - pair.first * d.transpose());
            for (int j = 0; j < 6; ++j)
                for (int i = a == b ? j : 0; i < 6; ++i)
                    sum.at(6 * a + i, 6 * b + j) += static_cast<float>(block(i, j));
        }
}

void CoarseMatrix::add_part(std::size_t part, const Points& x, const ElasticTerms& terms,
                            const std::vector<double>& inverse_mass, const Points& normals) {
    BandedCholesky& sum = sums_[part];
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
    BandedCholesky& matrix = sums_[0];
    for (std::size_t p = 1; p < parts; ++p)
        matrix.add(sums_[p]);
    for (int i = 0; i < basis_.unknowns(); ++i)
        matrix.at(i, i) += 1e-6F * matrix.at(i, i) + 1e-6F;
    matrix.factor();
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
