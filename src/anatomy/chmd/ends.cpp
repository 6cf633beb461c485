#include "ends.hpp"

#include "curve_tools.hpp"

#include "fascicle/anatomy/assignment.hpp"
#include "fascicle/base/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fascicle::chmd {

namespace {

constexpr double steepest_bend = 4.0 * std::numbers::pi / 9.0;
constexpr double distance_share = 0.1; ///< so that a long way straight ahead is not free
constexpr int most_rounds = 10;
constexpr double most_trim = 0.45;
constexpr unsigned origin_seed = 21, insertion_seed = 22;

/// Open end of a strand and the unit direction in which it leaves the muscle's middle.
struct OpenEnd {
    Vec3 point, direction;
};

OpenEnd open_end(const Strand& strand, double trim, bool at_origin) {
    const auto share = [&](double from_end) { return at_origin ? from_end : 1.0 - from_end; };
    OpenEnd end;
    end.point = point_at_share(strand.path, share(trim));
    end.direction = end.point - point_at_share(strand.path, share(trim + 0.1));
    if (end.direction.norm() > 0.0)
        end.direction.normalize();
    return end;
}

double bend(const OpenEnd& end, const Vec3& target) {
    const Vec3 way = target - end.point;
    return std::atan2(end.direction.cross(way).norm(), end.direction.dot(way));
}

int head(const Strand& strand, bool at_origin) {
    return at_origin ? strand.origin_head : strand.insertion_head;
}

/// Per head the triangles that are its own, those nearest to one of its control fibres' ends; all of them where it would
/// have none.
std::vector<std::vector<Tri>> triangles_of_heads(const Points& positions, const PatchSurface& patch,
                                                 const Rows& rows, bool at_origin) {
    const int fibres = rows.spans() + 1, heads = rows.head(fibres - 1, at_origin) + 1;
    if (heads == 1)
        return {patch.triangles};
    std::vector<std::vector<Tri>> own(static_cast<std::size_t>(heads));
    for (const Tri& t : patch.triangles) {
        const Vec3 centre =
            (positions[static_cast<std::size_t>(t[0])] + positions[static_cast<std::size_t>(t[1])] +
             positions[static_cast<std::size_t>(t[2])]) /
            3.0;
        int nearest = 0;
        for (int i = 1; i < fibres; ++i)
            if ((rows.end(i, at_origin) - centre).squaredNorm() <
                (rows.end(nearest, at_origin) - centre).squaredNorm())
                nearest = i;
        own[static_cast<std::size_t>(rows.head(nearest, at_origin))].push_back(t);
    }
    for (auto& triangles : own)
        if (triangles.empty())
            triangles = patch.triangles;
    return own;
}

/// Assigns the strands of one head and shortens them; writes their rows of `ends`.
void assign_head(const FibreProblem& problem, const std::vector<Strand>& strands,
                 const std::vector<int>& members, const Points& samples, bool at_origin, StrandEnds& ends) {
    const std::size_t n = members.size();
    std::vector<double> cost(n * n);
    std::vector<OpenEnd> open(n);
    std::vector<char> moved(n, 1);
    for (int round = 0; round <= most_rounds; ++round) {
        for (std::size_t i = 0; i < n; ++i) {
            const auto strand = static_cast<std::size_t>(members[i]);
            if (moved[i])
                open[i] = open_end(strands[strand], ends.trim[strand], at_origin);
        }
        parallel_for(problem.threads, n, 16, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                for (std::size_t k = 0; k < n && moved[i]; ++k)
                    cost[i * n + k] = (samples[k] - open[i].point).squaredNorm() *
                                      (distance_share + bend(open[i], samples[k]) / std::numbers::pi);
        });
        const Assignment chosen = assign(cost, static_cast<int>(n));
        bool again = false;
        for (std::size_t i = 0; i < n; ++i) {
            const auto strand = static_cast<std::size_t>(members[i]);
            const Vec3& target = samples[static_cast<std::size_t>(chosen.column[i])];
            ends.targets[strand] = target;
            moved[i] = 0;
            if (round == most_rounds || bend(open[i], target) <= steepest_bend ||
                ends.trim[strand] >= most_trim)
                continue;
            ends.trim[strand] =
                std::min(most_trim, ends.trim[strand] + 0.1 * std::max(strands[strand].depth, 1.0 / 3.0));
            moved[i] = 1;
            again = true;
        }
        if (!again)
            break;
    }
}

} // namespace

StrandEnds assign_ends(const FibreProblem& problem, const Rows& rows, const std::vector<Strand>& strands,
                       const PatchSurface& patch, bool at_origin) {
    StrandEnds ends;
    ends.trim.assign(strands.size(), 0.0);
    ends.targets.assign(strands.size(), Vec3::Zero());
    const auto own = triangles_of_heads(problem.surface->positions, patch, rows, at_origin);
    for (std::size_t h = 0; h < own.size(); ++h) {
        std::vector<int> members;
        for (std::size_t i = 0; i < strands.size(); ++i)
            if (head(strands[i], at_origin) == static_cast<int>(h))
                members.push_back(static_cast<int>(i));
        const unsigned seed = (at_origin ? origin_seed : insertion_seed) + 100 * static_cast<unsigned>(h);
        const Points samples =
            sample_patch(problem.surface->positions, own[h], static_cast<int>(members.size()), seed);
        assign_head(problem, strands, members, samples, at_origin, ends);
    }
    return ends;
}

} // namespace fascicle::chmd
