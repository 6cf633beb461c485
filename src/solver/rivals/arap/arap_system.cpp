#include "solver/rivals/arap/arap_system.hpp"

#include "fascicle/base/error.hpp"

namespace fascicle::solver {

ArapSystem::ArapSystem(const ArapCells& cells, const std::vector<std::uint8_t>& free,
                       const std::vector<double>& penalties)
    : cells_(&cells), unknown_(free.size(), -1) {
    for (std::size_t i = 0; i < free.size(); ++i)
        if (free[i] != 0) {
            unknown_[i] = static_cast<int>(vertex_.size());
            vertex_.push_back(static_cast<int>(i));
        }
    std::vector<Eigen::Triplet<double>> entries; // the lower triangle
    for (std::size_t k = 0; k < vertex_.size(); ++k) {
        const auto i = static_cast<std::size_t>(vertex_[k]);
        entries.emplace_back(int(k), int(k), cells.weight_at(i));
        for (const ArapCells::Link& link : cells.links(i))
            if (const int other = unknown_[static_cast<std::size_t>(link.other)];
                other >= 0 && other < int(k))
                entries.emplace_back(int(k), other, -link.weight);
    }
    const auto n = static_cast<Eigen::Index>(vertex_.size());
    matrix_.resize(n, n);
    matrix_.setFromTriplets(entries.begin(), entries.end());
    work_.resize(vertex_.size());
    if (vertex_.empty())
        return;
    factor_.analyzePattern(matrix_);
    set_penalties(penalties);
}

void ArapSystem::set_penalties(const std::vector<double>& penalties) {
    if (vertex_.empty())
        return;
    for (std::size_t k = 0; k < vertex_.size(); ++k) {
        const auto i = static_cast<std::size_t>(vertex_[k]);
        // The diagonal comes first in a column of the lower triangle.
        matrix_.valuePtr()[matrix_.outerIndexPtr()[k]] = cells_->weight_at(i) + penalties[i];
    }
    factor_.factorize(matrix_);
    if (factor_.info() != Eigen::Success || !(factor_.vectorD().minCoeff() > 0.0))
        throw_error("arap", "the system of " + std::to_string(vertex_.size()) + " vertices is singular",
                    "finite positions, and triangles that have an area");
}

/// All six columns in one walk over the factor, which costs more to read than to use: P' L D L' P x = b.
void ArapSystem::solve(const Points& b, const Points& f, Points& x, Points& y) {
    y.assign(unknown_.size(), Vec3::Zero());
    if (vertex_.empty())
        return;
    const auto n = static_cast<int>(vertex_.size());
    const auto& order = factor_.permutationP().indices();
    for (int k = 0; k < n; ++k) {
        const auto i = static_cast<std::size_t>(vertex_[static_cast<std::size_t>(k)]);
        Two right;
        right << b[i], f[i];
        for (const ArapCells::Link& link : cells_->links(i))
            if (unknown_[static_cast<std::size_t>(link.other)] < 0)
                right.col(0) += link.weight * x[static_cast<std::size_t>(link.other)];
        work_[static_cast<std::size_t>(order[k])] = right;
    }
    const auto& lower = factor_.matrixL().nestedExpression();
    const auto* starts = lower.outerIndexPtr();
    const auto* rows = lower.innerIndexPtr();
    const double* values = lower.valuePtr();
    for (int column = 0; column < n; ++column) {
        const Two done = work_[static_cast<std::size_t>(column)];
        for (auto at = starts[column]; at < starts[column + 1]; ++at)
            work_[static_cast<std::size_t>(rows[at])] -= values[at] * done;
    }
    const auto& diagonal = factor_.vectorD();
    for (int column = n - 1; column >= 0; --column) {
        Two sum = work_[static_cast<std::size_t>(column)] / diagonal[column];
        for (auto at = starts[column]; at < starts[column + 1]; ++at)
            sum -= values[at] * work_[static_cast<std::size_t>(rows[at])];
        work_[static_cast<std::size_t>(column)] = sum;
    }
    for (int k = 0; k < n; ++k) {
        const auto i = static_cast<std::size_t>(vertex_[static_cast<std::size_t>(k)]);
        x[i] = work_[static_cast<std::size_t>(order[k])].col(0);
        y[i] = work_[static_cast<std::size_t>(order[k])].col(1);
    }
}

std::size_t ArapSystem::bytes() const {
    const auto sparse = [](const auto& m) {
        return static_cast<std::size_t>(m.nonZeros()) * (sizeof(double) + sizeof(int)) +
               static_cast<std::size_t>(m.outerSize() + 1) * sizeof(int);
    };
    return bytes_of(vertex_, unknown_, work_) + sparse(matrix_) +
           (vertex_.empty() ? 0 : sparse(factor_.matrixL().nestedExpression()));
}

} // namespace fascicle::solver
