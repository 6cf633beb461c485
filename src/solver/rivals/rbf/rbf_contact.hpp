#pragma once
// A radial basis field with a few more centres, without factoring it anew. With K the field's system, B the columns
// [psi(x_i - y_k); p(y_k)] of the new centres y_k and C_kl = psi(y_k - y_l), the bordered system
//   [K B; B^T C] [.; c] = [0; r]  has  S c = r,  S = C - B^T Z,  K Z = B,  and the field's own coefficients are -Z c.
// S is positive definite as the whole is on its side conditions, which hold with the new centres in them. Columns of B and Z are kept
// from solve to solve: who touches a bone in one frame mostly does so in the next.

#include "solver/rivals/rbf/rbf_field.hpp"

namespace fascicle::solver {

class RbfContact {
public:
    RbfContact() = default;
    /// field must outlive this. points: V places, of which centres are taken; most: of them at once.
    RbfContact(const RbfField& field, const Points& points, int most);

    /// The field that is zero at its centres and r (M x 3) at the points `chosen` (M <= most, different): (size() + M) x 3
    /// coefficients, for evaluate(). False, and nothing, when the new centres are too near to each other or to the field's.
    bool solve(const std::vector<int>& chosen, const RbfMatrix& r, RbfMatrix& coefficients);
    std::size_t bytes() const;

private:
    void keep_columns(const std::vector<int>& chosen);

    const RbfField* field_ = nullptr;
    const Points* points_ = nullptr;
    std::vector<int> slot_; ///< by point, of its column; -1 none
    Eigen::Index used_ = 0;
    RbfMatrix b_, z_; ///< size() x slots
};

} // namespace fascicle::solver
