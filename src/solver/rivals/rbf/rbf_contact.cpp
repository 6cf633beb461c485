#include "solver/rivals/rbf/rbf_contact.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/bytes_of.hpp"

#include <algorithm>

namespace fascicle::solver {

RbfContact::RbfContact(const RbfField& field, const Points& points, int most)
    : field_(&field), points_(&points), slot_(points.size(), -1), b_(field.size(), 2 * most),
      z_(field.size(), 2 * most) {}

void RbfContact::keep_columns(const std::vector<int>& chosen) {
    const auto is_new = [&](int p) { return slot_[static_cast<std::size_t>(p)] < 0; };
    auto wanted = std::count_if(chosen.begin(), chosen.end(), is_new);
    if (used_ + wanted > b_.cols()) {
        std::fill(slot_.begin(), slot_.end(), -1);
        used_ = 0;
        wanted = static_cast<std::ptrdiff_t>(chosen.size());
    }
    if (wanted == 0)
        return;
    const Eigen::Index first = used_;
    for (const int p : chosen)
        if (is_new(p)) {
            slot_[static_cast<std::size_t>(p)] = static_cast<int>(used_);
            field_->column((*points_)[static_cast<std::size_t>(p)], b_.col(used_++));
        }
    z_.middleCols(first, used_ - first) = field_->solve(b_.middleCols(first, used_ - first));
}

bool RbfContact::solve(const std::vector<int>& chosen, const RbfMatrix& r, RbfMatrix& coefficients) {
    const auto m = static_cast<Eigen::Index>(chosen.size());
    FASCICLE_ASSERT(r.rows() == m && 2 * m <= b_.cols());
    keep_columns(chosen);
    RbfMatrix b(field_->size(), m), z(field_->size(), m), s(m, m);
    for (Eigen::Index k = 0; k < m; ++k) {
        const auto p = static_cast<std::size_t>(chosen[static_cast<std::size_t>(k)]);
        b.col(k) = b_.col(slot_[p]);
        z.col(k) = z_.col(slot_[p]);
        for (Eigen::Index l = 0; l < m; ++l)
            s(l, k) = field_->psi(
                ((*points_)[p] - (*points_)[static_cast<std::size_t>(chosen[static_cast<std::size_t>(l)])])
                    .squaredNorm());
    }
    s.noalias() -= b.transpose() * z;
    const Eigen::LLT<RbfMatrix> factor(s);
    if (factor.info() != Eigen::Success)
        return false;
    coefficients.resize(field_->size() + m, 3);
    coefficients.bottomRows(m) = factor.solve(r);
    coefficients.topRows(field_->size()).noalias() = -z * coefficients.bottomRows(m);
    return coefficients.allFinite();
}

std::size_t RbfContact::bytes() const {
    return bytes_of(slot_) + static_cast<std::size_t>(b_.size() + z_.size()) * sizeof(double);
}

} // namespace fascicle::solver
