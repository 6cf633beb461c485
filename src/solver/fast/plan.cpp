#include "solver/fast/plan.hpp"

#include "fascicle/geometry/float_rounding.hpp"
#include "solver/coarse/elastic_terms.hpp"
#include "solver/constraints/dihedral.hpp"
#include "solver/constraints/distance.hpp"
#include "solver/edge_constraints.hpp"
#include "solver/fast/packing.hpp"
#include "solver/fast/plan_order.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::solver::fast {

namespace {

/// Constraints of one set with their record numbers, and what becomes of them in packets.
struct SetItems {
    std::vector<int> numbers; ///< into the list of constraints
    std::vector<int> corners; ///< records, arity in a row
};

/// Deals constraints by record numbers into interiors (0 .. blocks - 1) and interfaces (blocks ..).
template <typename Corners>
std::vector<SetItems> deal(std::size_t count, const BlockLayout& layout, std::size_t arity,
                           const Corners& corners) {
    std::vector<SetItems> sets(2 * layout.blocks());
    const auto block_of = [&](int record) {
        const auto next = std::upper_bound(layout.first_record.begin(), layout.first_record.end(),
                                           static_cast<std::size_t>(record));
        return static_cast<std::size_t>(next - layout.first_record.begin()) - 1;
    };
    std::vector<std::array<int, 2>> by_first; // least record, constraint
    for (std::size_t c = 0; c < count; ++c) {
        int low = corners(c, 0);
        for (std::size_t k = 1; k < arity; ++k)
            low = std::min(low, corners(c, k));
        by_first.push_back({low, static_cast<int>(c)});
    }
    std::sort(by_first.begin(), by_first.end());
    for (const auto& [low, c] : by_first) {
        int high = low;
        for (std::size_t k = 0; k < arity; ++k)
            high = std::max(high, corners(static_cast<std::size_t>(c), k));
        const std::size_t block = block_of(low);
        auto& set = sets[block_of(high) == block ? block : layout.blocks() + block];
        set.numbers.push_back(c);
        for (std::size_t k = 0; k < arity; ++k)
            set.corners.push_back(corners(static_cast<std::size_t>(c), k));
    }
    return sets;
}

class PlanMaker {
public:
    PlanMaker(const SoftBodyProblem& problem, const MeshTopology& topology, const std::vector<bool>& held,
              double kappa, Plan& plan, const BlockLayout& layout)
        : problem_(problem), topology_(topology), held_(held), kappa_(kappa), plan_(plan), layout_(layout) {}

    bool make() {
        place_vertices();
        return lay_out_rings(problem_.surface->triangles, topology_, plan_) && pack_constraints();
    }

private:
    void place_vertices() {
        const Points& rest = problem_.surface->positions;
        Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);
        for (const Vec3& p : rest) {
            low = low.cwiseMin(p);
            high = high.cwiseMax(p);
        }
        plan_.origin = 0.5 * (low + high);
        plan_.inverse_mass.assign(plan_.records(), 0.0f);
        for (std::size_t i = 0; i < rest.size(); ++i) {
            plan_.rest.push_back(rest[i] - plan_.origin);
            const bool held =
                problem_.body_of_vertex[i] >= 0 || topology_.vertex_component(static_cast<int>(i)) < 0;
            plan_.inverse_mass[record(static_cast<int>(i))] = held ? 0.0f : 1.0f;
        }
        round_to_floats(plan_.rest);
    }

    bool pack_constraints() {
        const double h = problem_.parameters.get("solver.frame_time") / passes_per_frame(problem_.parameters);
        const double per_h2 = 1.0 / (h * h);
        const std::vector<DistanceConstraint> all_edges =
            make_edge_constraints(problem_, plan_.rest, topology_);
        std::vector<DistanceConstraint> edges;
        for (const DistanceConstraint& e : all_edges)
            if (mass(e.a) + mass(e.b) > 0.0f)
                edges.push_back(e);
        const DihedralConstraints all_hinges(plan_.rest, topology_.dihedrals(),
                                             problem_.parameters.get("solver.bending"));
        std::vector<DihedralConstraint> hinges;
        for (const DihedralConstraint& d : all_hinges.items())
            if (mass(d.p[0]) + mass(d.p[1]) + mass(d.p[2]) + mass(d.p[3]) > 0.0f)
                hinges.push_back(d);

        const auto edge_sets = deal(edges.size(), layout_, 2, [&](std::size_t c, std::size_t k) {
            return static_cast<int>(record(k == 0 ? edges[c].a : edges[c].b));
        });
        const auto hinge_sets = deal(hinges.size(), layout_, 4, [&](std::size_t c, std::size_t k) {
            return static_cast<int>(record(hinges[c].p[k]));
        });
        std::vector<bool> movable;
        for (const float w : plan_.inverse_mass)
            movable.push_back(w > 0.0f);
        std::vector<int> rows;
        for (std::size_t s = 0; s < 2 * layout_.blocks(); ++s) {
            const std::size_t block = s % layout_.blocks();
            ConstraintSet set{layout_.first_record[block], plan_.edges.size(), 0, plan_.hinges.size(), 0};
            if (!pack(edge_sets[s].corners, 2, movable, rows))
                return false;
            for (std::size_t r = 0; r < rows.size(); r += packet) {
                const std::span<const int> row{rows.data() + r, packet};
                plan_.edges.push_back(edge_packet(edges, edge_sets[s].numbers, row, set, per_h2));
                if (!problem_.edge_along.empty())
                    plan_.active.push_back(active_packet(edges, edge_sets[s].numbers, row));
            }
            if (!pack(hinge_sets[s].corners, 4, movable, rows))
                return false;
            for (std::size_t r = 0; r < rows.size(); r += packet)
                plan_.hinges.push_back(
                    hinge_packet(hinges, hinge_sets[s].numbers, {rows.data() + r, packet}, set, per_h2));
            set.edges = plan_.edges.size() - set.first_edge;
            set.hinges = plan_.hinges.size() - set.first_hinge;
            (s < layout_.blocks() ? plan_.interiors : plan_.interfaces).push_back(set);
        }
        plan_.interfaces.pop_back(); // behind the last block there is nothing
        plan_.edges.shrink_to_fit(); // kept for the whole run
        plan_.active.shrink_to_fit();
        plan_.hinges.shrink_to_fit();
        plan_.rings.shrink_to_fit();
        return true;
    }

    /// Padding record k of the set's block: unmovable, each at a place of its own.
    std::uint16_t dummy(std::size_t k, const ConstraintSet& set) const {
        const auto end =
            std::upper_bound(layout_.first_record.begin(), layout_.first_record.end(), set.first_record);
        return static_cast<std::uint16_t>(*end - set.first_record - block_dummies + k);
    }
    std::uint16_t index(int vertex, const ConstraintSet& set) const {
        return static_cast<std::uint16_t>(record(vertex) - set.first_record);
    }

    EdgePacket edge_packet(const std::vector<DistanceConstraint>& all, const std::vector<int>& numbers,
                           std::span<const int> row, const ConstraintSet& set, double per_h2) {
        EdgePacket p{};
        for (std::size_t i = 0; i < packet; ++i) {
            p.p[0][i] = dummy(0, set);
            p.p[1][i] = dummy(1, set);
            if (row[i] < 0) {
                ++plan_.padding;
                continue;
            }
            const DistanceConstraint& e =
                all[static_cast<std::size_t>(numbers[static_cast<std::size_t>(row[i])])];
            p.rest[i] = static_cast<float>(e.rest);
            const double weight = static_cast<double>(mass(e.a)) + static_cast<double>(mass(e.b));
            const double softness = e.compliance * per_h2;
            p.gain[i] = static_cast<float>(1.0 / std::max(weight + softness, kappa_ * softness));
            p.stiffness[i] = static_cast<float>(
                (1.0 - 1.0 / kappa_) /
                (std::max(e.compliance, compliance_from_stiffness(stiffest_coarse, 2.0)) * per_h2));
            p.p[0][i] = index(e.a, set);
            p.p[1][i] = index(e.b, set);
        }
        return p;
    }

    static ActivePacket active_packet(const std::vector<DistanceConstraint>& all,
                                      const std::vector<int>& numbers, std::span<const int> row) {
        ActivePacket p{};
        for (std::size_t i = 0; i < packet; ++i) {
            if (row[i] < 0)
                continue;
            const DistanceConstraint& e =
                all[static_cast<std::size_t>(numbers[static_cast<std::size_t>(row[i])])];
            p.rest[i] = static_cast<float>(e.rest);
            p.along[i] = static_cast<float>(e.along);
        }
        return p;
    }

    HingePacket hinge_packet(const std::vector<DihedralConstraint>& all, const std::vector<int>& numbers,
                             std::span<const int> row, const ConstraintSet& set, double per_h2) {
        HingePacket p{};
        for (std::size_t i = 0; i < packet; ++i) {
            for (std::size_t k = 0; k < 4; ++k)
                p.p[k][i] = dummy(k, set);
            p.cosine[i] = 1.0f;
            p.compliance[i] = 1.0f;
            if (row[i] < 0) {
                ++plan_.padding;
                continue;
            }
            const DihedralConstraint& d =
                all[static_cast<std::size_t>(numbers[static_cast<std::size_t>(row[i])])];
            p.cosine[i] = static_cast<float>(std::cos(d.rest_rad));
            p.sine[i] = static_cast<float>(std::sin(d.rest_rad));
            p.compliance[i] = static_cast<float>(d.compliance * per_h2);
            for (std::size_t k = 0; k < 4; ++k)
                p.p[k][i] = index(d.p[k], set);
        }
        return p;
    }

    std::size_t record(int vertex) const {
        return static_cast<std::size_t>(plan_.record_of_vertex[static_cast<std::size_t>(vertex)]);
    }
    float mass(int vertex) const { return plan_.inverse_mass[record(vertex)]; }

    const SoftBodyProblem& problem_;
    const MeshTopology& topology_;
    const std::vector<bool>& held_;
    const double kappa_;
    Plan& plan_;
    const BlockLayout& layout_;
};

} // namespace

std::optional<Plan> make_plan(const SoftBodyProblem& problem, const MeshTopology& topology, double kappa) {
    std::vector<bool> held;
    for (const double mass : inverse_masses(problem, topology))
        held.push_back(mass == 0.0);
    Plan plan;
    plan.relax = static_cast<float>(kappa);
    const auto layout = lay_out_blocks(topology, held, plan);
    if (!layout || !PlanMaker(problem, topology, held, kappa, plan, *layout).make())
        return std::nullopt;
    return plan;
}

} // namespace fascicle::solver::fast
