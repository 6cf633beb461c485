#include "solver/rivals/lines/end_shares.hpp"

#include "fascicle/base/error.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>

namespace fascicle::solver {

EndShares end_shares(const SoftBodyProblem& problem, const MeshTopology& topology) {
    const Points& rest = problem.surface->positions;
    const std::vector<int>& body = problem.body_of_vertex;
    EndShares shares;
    std::vector<char> held(static_cast<std::size_t>(topology.component_count()), 0); ///< by component
    for (std::size_t v = 0; v < body.size(); ++v) {
        const int component = topology.vertex_component(static_cast<int>(v));
        if (body[v] < 0)
            continue;
        shares.solids.push_back(body[v]);
        if (component >= 0)
            held[static_cast<std::size_t>(component)] = 1;
    }
    std::sort(shares.solids.begin(), shares.solids.end());
    shares.solids.erase(std::unique(shares.solids.begin(), shares.solids.end()), shares.solids.end());
    const std::size_t solids = shares.solids.size();
    shares.values.assign(body.size() * solids, 0.0);

    std::vector<int> row(body.size(), -1);
    int rows = 0;
    for (std::size_t v = 0; v < body.size(); ++v) {
        const int component = topology.vertex_component(static_cast<int>(v));
        if (body[v] >= 0) {
            const auto s = std::lower_bound(shares.solids.begin(), shares.solids.end(), body[v]);
            shares.values[v * solids + static_cast<std::size_t>(s - shares.solids.begin())] = 1.0;
        } else if (component >= 0 && held[static_cast<std::size_t>(component)] != 0)
            row[v] = rows++;
    }
    if (rows == 0)
        return shares;
    double mean = 0;
    for (const Edge& e : topology.edges())
        mean += (rest[static_cast<std::size_t>(e.a)] - rest[static_cast<std::size_t>(e.b)]).norm() /
                double(topology.edges().size());
    if (!(mean > 0.0))
        mean = 1.0; // every vertex at one place
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(rows, static_cast<Eigen::Index>(solids));
    for (const Edge& e : topology.edges()) {
        const auto a = static_cast<std::size_t>(e.a), b = static_cast<std::size_t>(e.b);
        const double w = 1.0 / std::max((rest[a] - rest[b]).norm(), 1e-6 * mean);
        for (const auto& [me, other] : {std::pair{a, b}, std::pair{b, a}}) {
            if (row[me] < 0)
                continue;
            entries.emplace_back(row[me], row[me], w);
            if (row[other] >= 0)
                entries.emplace_back(row[me], row[other], -w);
            else
                for (std::size_t s = 0; s < solids; ++s)
                    right(row[me], static_cast<Eigen::Index>(s)) += w * shares.of(other, s);
        }
    }
    Eigen::SparseMatrix<double> matrix(rows, rows);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
    if (factor.info() != Eigen::Success)
        throw_error("lines", "the shares of the attachments could not be found",
                    "a surface whose points are finite");
    const Eigen::MatrixXd solved = factor.solve(right);
    for (std::size_t v = 0; v < body.size(); ++v)
        for (std::size_t s = 0; row[v] >= 0 && s < solids; ++s)
            shares.values[v * solids + s] =
                std::clamp(solved(row[v], static_cast<Eigen::Index>(s)), 0.0, 1.0);
    return shares;
}

} // namespace fascicle::solver
