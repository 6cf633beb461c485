#include "solver/rivals/block_matrix.hpp"

#include "fascicle/base/assert.hpp"

#include <algorithm>

namespace fascicle::solver {

BlockMatrix::BlockMatrix(const std::vector<int>& starts, const std::vector<int>& neighbours) {
    const int count = static_cast<int>(starts.size()) - 1;
    starts_.assign(1, 0);
    for (int a = 0; a < count; ++a) {
        const auto begin = neighbours.begin() + starts[static_cast<std::size_t>(a)];
        const auto end = neighbours.begin() + starts[static_cast<std::size_t>(a) + 1];
        const auto middle = std::lower_bound(begin, end, a);
        rows_.insert(rows_.end(), begin, middle);
        rows_.push_back(a);
        rows_.insert(rows_.end(), middle, end);
        starts_.push_back(static_cast<int>(rows_.size()));
    }
    matrix_.resize(3 * count, 3 * count);
    matrix_.resizeNonZeros(9 * starts_.back());
    int at = 0;
    for (int b = 0; b < count; ++b)
        for (int axis = 0; axis < 3; ++axis) {
            matrix_.outerIndexPtr()[3 * b + axis] = at;
            for (int k = starts_[static_cast<std::size_t>(b)]; k < starts_[static_cast<std::size_t>(b) + 1];
                 ++k)
                for (int row = 0; row < 3; ++row)
                    matrix_.innerIndexPtr()[at++] = 3 * rows_[static_cast<std::size_t>(k)] + row;
        }
    matrix_.outerIndexPtr()[3 * count] = at;
    clear();
}

void BlockMatrix::clear() {
    std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0);
}

int BlockMatrix::place(int row, int column) const {
    const auto begin = rows_.begin() + starts_[static_cast<std::size_t>(column)];
    const auto end = rows_.begin() + starts_[static_cast<std::size_t>(column) + 1];
    const auto it = std::lower_bound(begin, end, row);
    FASCICLE_ASSERT(it != end && *it == row);
    return static_cast<int>(it - begin);
}

void BlockMatrix::add(int place, int column, const Eigen::Ref<const Mat3>& block) {
    for (int axis = 0; axis < 3; ++axis) {
        double* value = matrix_.valuePtr() + matrix_.outerIndexPtr()[3 * column + axis] + 3 * place;
        value[0] += block(0, axis);
        value[1] += block(1, axis);
        value[2] += block(2, axis);
    }
}

double BlockMatrix::mean_diagonal() const {
    return matrix_.cols() == 0 ? 0.0 : matrix_.diagonal().sum() / double(matrix_.cols());
}

void BlockMatrix::add_to_diagonal(double shift) {
    for (int b = 0; b + 1 < static_cast<int>(starts_.size()); ++b)
        add(place(b, b), b, shift * Mat3::Identity());
}

void BlockMatrix::fix(const std::vector<std::uint8_t>& fixed) {
    const double diagonal = mean_diagonal();
    for (int column = 0; column < static_cast<int>(matrix_.cols()); ++column)
        for (Eigen::SparseMatrix<double>::InnerIterator it(matrix_, column); it; ++it)
            if (fixed[static_cast<std::size_t>(it.row())] != 0 ||
                fixed[static_cast<std::size_t>(column)] != 0)
                it.valueRef() = it.row() == column ? diagonal : 0.0;
}

} // namespace fascicle::solver
