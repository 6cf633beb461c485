#include "solver/rivals/polar.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::solver {

namespace {

/// One Jacobi rotation that makes a(p, q) zero (Golub & Van Loan, "Matrix computations", 8.5.2).
void rotate(Mat3& a, Mat3& v, int p, int q) {
    if (a(p, q) == 0.0)
        return;
    const double theta = (a(q, q) - a(p, p)) / (2.0 * a(p, q));
    const double t = (theta >= 0.0 ? 1.0 : -1.0) /
                     (std::abs(theta) + std::sqrt(theta * theta + 1.0)); // 0 for infinite theta
    const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
    const int r = 3 - p - q;
    const double apq = a(p, q), arp = a(r, p), arq = a(r, q);
    a(p, p) -= t * apq;
    a(q, q) += t * apq;
    a(p, q) = a(q, p) = 0.0;
    a(r, p) = a(p, r) = c * arp - s * arq;
    a(r, q) = a(q, r) = s * arp + c * arq;
    for (int i = 0; i < 3; ++i) {
        const double vip = v(i, p), viq = v(i, q);
        v(i, p) = c * vip - s * viq;
        v(i, q) = s * vip + c * viq;
    }
}

} // namespace

SignedSvd signed_svd(const Mat3& f) {
    Mat3 a = f.transpose() * f, v = Mat3::Identity();
    const double enough = 1e-17 * a.trace();
    for (int sweep = 0; sweep < 12; ++sweep) {
        rotate(a, v, 0, 1);
        rotate(a, v, 0, 2);
        rotate(a, v, 1, 2);
        if (std::abs(a(0, 1)) + std::abs(a(0, 2)) + std::abs(a(1, 2)) <= enough)
            break;
    }
    std::array<int, 3> order{0, 1, 2};
    std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return a(i, i) > a(j, j); });
    SignedSvd svd;
    svd.v << v.col(order[0]), v.col(order[1]), v.col(order[2]);
    if (svd.v.determinant() < 0.0)
        svd.v.col(2) = -svd.v.col(2);
    const Mat3 w = f * svd.v;
    const double first = w.col(0).norm();
    svd.u.col(0) = first > 0.0 ? Vec3(w.col(0) / first) : Vec3(svd.v.col(0));
    Vec3 second = w.col(1) - w.col(1).dot(svd.u.col(0)) * svd.u.col(0);
    if (!(second.norm() > 1e-12 * first)) { // rank 1: any direction across will do
        int least = 0;
        svd.u.col(0).cwiseAbs().minCoeff(&least);
        second = svd.u.col(0).cross(Vec3::Unit(least));
    }
    svd.u.col(1) = second.normalized();
    svd.u.col(2) = svd.u.col(0).cross(svd.u.col(1));
    for (int i = 0; i < 3; ++i)
        svd.sigma[i] = svd.u.col(i).dot(w.col(i));
    return svd;
}

} // namespace fascicle::solver
