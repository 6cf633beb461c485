#include "anatomy/fibres/fibre_finish.hpp"

#include "anatomy/fibres/bind_to_chords.hpp"
#include "anatomy/fibres/fibre_field.hpp"
#include "fascicle/base/parallel.hpp"
#include "fascicle/geometry/bounding_box.hpp"

#include <algorithm>
#include <cstdio>

namespace fascicle {

namespace {

/// How far below the surface inner points stay, as a part of the surface's size: about 0.1 mm for a big muscle.
constexpr double rest_depth = 3e-4;

/// Looks at the segments of the fibres marked in `look` whose middle is outside by more than `tolerance`, and moves their
/// inner ends by as much as the middle is moved in (depth > 0). Marks the fibres that had such; returns how many middles
/// there were.
int bring_middles_in(const MuscleInside& inside, FibreSet& fibres, std::vector<char>& look, double depth,
                     double tolerance, int threads) {
    const auto per_fibre = fibres.points_per_fibre();
    std::vector<int> outside(look.size(), 0);
    parallel_for(threads, outside.size(), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            Vec3* const p = fibres.points.data() + f * per_fibre;
            for (std::size_t j = 0; look[f] != 0 && j + 1 < per_fibre; ++j) {
                Vec3 middle = 0.5 * (p[j] + p[j + 1]);
                if (inside.inside(middle) || (tolerance > 0 && -inside.depth(middle) <= tolerance))
                    continue;
                ++outside[f];
                if (depth <= 0)
                    continue;
                const Vec3 before = middle;
                inside.move(middle, depth);
                const Vec3 shift = middle - before;
                for (const std::size_t k : {j, j + 1})
                    if (k > 0 && k + 1 < per_fibre) {
                        p[k] += shift;
                        inside.move(p[k], depth);
                    }
            }
            look[f] = outside[f] > 0 ? 1 : 0;
        }
    });
    int sum = 0;
    for (const int count : outside)
        sum += count;
    return sum;
}

} // namespace

void ends_on_attachments(const FibreProblem& problem, FibreSet& fibres) {
    const auto per_fibre = fibres.points_per_fibre();
    for (const AttachmentKind kind : {AttachmentKind::origin, AttachmentKind::insertion}) {
        const TriangleBvh tree(problem.surface->positions, attached_triangles(problem, kind));
        for (std::size_t f = 0; f < static_cast<std::size_t>(fibres.count); ++f) {
            Vec3& end = fibres.points[f * per_fibre + (kind == AttachmentKind::origin ? 0 : per_fibre - 1)];
            end = tree.closest(end).point;
        }
    }
}

void smooth_fibres(FibreSet& fibres, int passes) {
    const auto per_fibre = fibres.points_per_fibre();
    for (std::size_t f = 0; f < static_cast<std::size_t>(fibres.count); ++f) {
        Vec3* const p = fibres.points.data() + f * per_fibre;
        for (int pass = 0; pass < passes; ++pass) {
            Vec3 before = p[0];
            for (std::size_t j = 1; j + 1 < per_fibre; ++j) {
                const Vec3 here = p[j];
                p[j] = (before + 4.0 * here + p[j + 1]) / 6.0;
                before = here;
            }
        }
    }
}

void finish_fibres(const FibreProblem& problem, const MuscleInside& inside, FibreModel& model) {
    Stopwatch watch;
    FibreSet& fibres = model.rest;
    const double depth =
        rest_depth * bounding_box(problem.surface->positions, problem.surface->triangles).diagonal();
    const auto per_fibre = fibres.points_per_fibre();
    std::vector<char> moved(static_cast<std::size_t>(fibres.count) * per_fibre, 0);
    parallel_for(problem.threads, static_cast<std::size_t>(fibres.count), 4,
                 [&](std::size_t begin, std::size_t end) {
                     for (std::size_t f = begin; f < end; ++f)
                         for (std::size_t j = 1; j + 1 < per_fibre; ++j) {
                             const std::size_t i = f * per_fibre + j;
                             moved[i] = inside.move(fibres.points[i], depth) ? 1 : 0;
                         }
                 });
    const auto count = std::count(moved.begin(), moved.end(), 1);
    if (count > 0)
        model.notes.push_back(std::to_string(count) + " of " + std::to_string(fibres.points.size()) +
                              " fibre points lay outside of the muscle or on its surface and were moved in");
    std::vector<char> look(static_cast<std::size_t>(fibres.count), 1);
    int middles = 1;
    for (int round = 0; round < 3 && middles > 0; ++round)
        middles = bring_middles_in(inside, fibres, look, depth, 0.0, problem.threads);
    middles = bring_middles_in(inside, fibres, look, 0.0, 0.5 / problem.unit_mm, problem.threads);
    if (middles > 0)
        model.notes.push_back(
            std::to_string(middles) + " of " + std::to_string(fibres.count * fibres.segments) +
            " segments leave the muscle by more than 0.5 mm between their points; more segments "
            "follow its bends closer");
    model.seconds.emplace_back("inside", watch.lap());
    model.carrier =
        bind_to_chords(*problem.surface, *problem.topology, inside.lines(), fibres.points, problem.threads);
    model.seconds.emplace_back("bind", watch.lap());
}

} // namespace fascicle
