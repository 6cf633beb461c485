#include "fascicle/anatomy/fibre_methods.hpp"

#include "anatomy/fibres/fibre_field.hpp"
#include "anatomy/fibres/fibre_finish.hpp"
#include "anatomy/fibres/volume_field.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/base/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fascicle {

namespace {

constexpr int wanted_cells = 40000;
constexpr int smoothing_passes = 2;

/// Points spread evenly over those given: farthest points first, then moved to the middles of their shares (Lloyd).
Points spread(const Points& among, std::size_t count) {
    std::vector<double> distance(among.size(), std::numeric_limits<double>::infinity());
    Points chosen;
    std::size_t next = 0;
    while (chosen.size() < count) {
        chosen.push_back(among[next]);
        for (std::size_t i = 0; i < among.size(); ++i)
            distance[i] = std::min(distance[i], (among[i] - chosen.back()).squaredNorm());
        next =
            static_cast<std::size_t>(std::max_element(distance.begin(), distance.end()) - distance.begin());
    }
    for (int round = 0; round < 6; ++round) {
        Points sum(count, Vec3::Zero());
        std::vector<int> members(count, 0);
        for (const Vec3& p : among) {
            std::size_t nearest = 0;
            double best = std::numeric_limits<double>::infinity();
            for (std::size_t k = 0; k < count; ++k)
                if (const double d = (p - chosen[k]).squaredNorm(); d < best) {
                    best = d;
                    nearest = k;
                }
            sum[nearest] += p;
            ++members[nearest];
        }
        for (std::size_t k = 0; k < count; ++k)
            if (members[k] > 0)
                chosen[k] = sum[k] / double(members[k]);
    }
    return chosen;
}

/// Places for seeds: the cells of the middle level, cut finer until there are several for each fibre.
Points seeds_of(const VolumeField& field, std::size_t count) {
    const Points cells = field.cells_at(0.5);
    if (cells.empty())
        return cells;
    int fine = 1;
    while (cells.size() * std::size_t(fine * fine * fine) < 6 * count && fine < 16)
        ++fine;
    Points places;
    for (const Vec3& p : cells)
        for (int k = 0; k < fine * fine * fine; ++k)
            places.push_back(
                p + field.step() *
                        ((Vec3(k % fine, k / fine % fine, k / (fine * fine)) + Vec3::Constant(0.5)) / fine -
                         Vec3::Constant(0.5)));
    return spread(places, count);
}

/// From a seed up (sign 1) or down (-1) the gradient in steps of half a cell by the midpoint rule, to where the field
/// reaches its end value nearly, turns back or ends.
Points trace(const VolumeField& field, const MuscleInside& inside, Vec3 p, double sign) {
    Points line;
    const double step = 0.5 * field.step();
    double last = field.value(p);
    Vec3 direction = Vec3::Zero();
    for (int k = 0; k < 20000; ++k) {
        const Vec3 here = sign * field.gradient(p);
        if (!(here.norm() > 0))
            break;
        const Vec3 middle = sign * field.gradient(p + 0.5 * step * here.normalized());
        direction = middle.norm() > 0 ? middle.normalized() : here.normalized();
        Vec3 next = p + step * direction;
        if (!inside.inside(next)) // the gradient runs along the surface up to the grid's steps
            inside.move(next, 0.25 * field.step());
        const double value = field.value(next);
        if (!(sign * (value - last) > 1e-12))
            break;
        line.push_back(next);
        p = next;
        last = value;
        if (sign > 0 ? value > 0.998 : value < 0.002)
            break;
    }
    return line;
}

void resample(const Points& line, int segments, Vec3* out) {
    std::vector<double> walked{0.0};
    for (std::size_t i = 1; i < line.size(); ++i)
        walked.push_back(walked.back() + (line[i] - line[i - 1]).norm());
    std::size_t k = 0;
    for (int j = 0; j <= segments; ++j) {
        const double target = walked.back() * j / segments;
        while (k + 2 < line.size() && walked[k + 1] < target)
            ++k;
        const double length = walked[k + 1] - walked[k];
        const double share = length > 0 ? std::clamp((target - walked[k]) / length, 0.0, 1.0) : 0.0;
        out[j] = (1.0 - share) * line[k] + share * line[k + 1];
    }
}

} // namespace

FibreModel decompose_streamlines(const FibreProblem& given) {
    FibreModel model;
    Stopwatch watch;
    const FibreProblem problem = checked_problem(given, model.notes);
    const MuscleInside inside(*problem.surface, problem.threads);
    const TriangleBvh origins(problem.surface->positions,
                              attached_triangles(problem, AttachmentKind::origin));
    const TriangleBvh insertions(problem.surface->positions,
                                 attached_triangles(problem, AttachmentKind::insertion));
    model.seconds.emplace_back("trees", watch.lap());
    const VolumeField field(problem, wanted_cells);
    model.seconds.emplace_back("field", watch.lap());

    FibreSet& fibres = model.rest;
    fibres.count = problem.count;
    fibres.segments = problem.segments;
    const auto per_fibre = fibres.points_per_fibre();
    fibres.points.resize(static_cast<std::size_t>(fibres.count) * per_fibre);
    const Points seeds = seeds_of(field, static_cast<std::size_t>(fibres.count));
    if (seeds.empty())
        throw_error(fibre_error_place(problem),
                    "no room between origin and insertion for a fibre to start in",
                    "attachments at least two cells of " + std::to_string(field.step() * problem.unit_mm) +
                        " mm apart");
    std::vector<char> far(seeds.size(), 0);
    parallel_for(problem.threads, seeds.size(), 2, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            Vec3 seed = seeds[f];
            inside.move(seed, 0.25 * field.step());
            Points line = trace(field, inside, seed, -1.0);
            std::reverse(line.begin(), line.end());
            line.push_back(seed);
            const Points up = trace(field, inside, seed, 1.0);
            line.insert(line.end(), up.begin(), up.end());
            const Vec3 first = origins.closest(line.front()).point,
                       last = insertions.closest(line.back()).point;
            const double gap = std::max((first - line.front()).norm(), (last - line.back()).norm());
            far[f] = gap > 4.0 * field.step() ? 1 : 0;
            line.insert(line.begin(), first);
            line.push_back(last);
            resample(line, problem.segments, fibres.points.data() + f * per_fibre);
        }
    });
    ends_on_attachments(problem, fibres);
    smooth_fibres(fibres, smoothing_passes);
    if (const auto count = std::count(far.begin(), far.end(), 1); count > 0)
        model.notes.push_back(std::to_string(count) +
                              " streamlines end short of an attachment and are led to it straight");
    model.seconds.emplace_back("streamlines", watch.lap());

    const Points& vertices = problem.surface->positions;
    for (const Vec3& p : vertices) {
        const double u = field.value(p);
        model.field.push_back(std::isfinite(u) ? std::clamp(u, 0.0, 1.0) : 0.0);
    }
    for (const AttachmentPatch& patch : problem.patches)
        for (const int v : patch.vertices)
            model.field[static_cast<std::size_t>(v)] = patch.kind == AttachmentKind::origin ? 0.0 : 1.0;
    finish_fibres(problem, inside, model);
    return model;
}

} // namespace fascicle
