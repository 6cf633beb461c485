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

constexpr int wanted_cells = 24000;
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

/// Even places on the origins, the same area for each: where as much of the flow enters. Every triangle is cut into small
/// equal ones; edges and single vertices count where there is no area at all.
Points seeds_on(const TriMesh& surface, const std::vector<Tri>& attached, std::size_t count) {
    const auto corner = [&](const Tri& t, std::size_t k) {
        return surface.positions[static_cast<std::size_t>(t[k])];
    };
    double area = 0;
    for (const Tri& t : attached)
        area += 0.5 * (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0)).norm();
    const double wanted = area / ((count > 300 ? 4.0 : 10.0) * double(count)); // of a place
    Points places;
    for (const Tri& t : attached) {
        const Vec3 a = corner(t, 0), u = corner(t, 1) - a, v = corner(t, 2) - a;
        const double here = 0.5 * u.cross(v).norm();
        if (area > 0 && !(here > 0))
            continue;
        const int pieces =
            area > 0 ? std::clamp(static_cast<int>(std::lround(std::sqrt(here / wanted))), 1, 64) : 4;
        for (int i = 0; i < pieces; ++i)
            for (int j = 0; i + j < pieces; ++j) {
                places.push_back(a + (i + 1.0 / 3) / pieces * u + (j + 1.0 / 3) / pieces * v);
                if (i + j + 1 < pieces)
                    places.push_back(a + (i + 2.0 / 3) / pieces * u + (j + 2.0 / 3) / pieces * v);
            }
    }
    return spread(places, count);
}

/// From a seed up the gradient in steps of half a cell by the midpoint rule, to the insertion, or where the field ends.
/// In a narrow corner of the surface the grid may have the field turn back: the line is then taken deeper in.
Points trace(const VolumeField& field, const MuscleInside& inside, Vec3 p) {
    Points line{p};
    const double step = 0.5 * field.step();
    double last = field.value(p);
    int stuck = 0;
    for (int k = 0; k < 20000 && stuck <= 12 && !field.at_insertion(p); ++k) {
        const Vec3 here = field.gradient(p);
        const Vec3 middle =
            here.norm() > 0 ? field.gradient(p + 0.5 * step * here.normalized()) : Vec3(Vec3::Zero());
        Vec3 next = p;
        if (here.norm() > 0)
            next += step * (middle.norm() > 0 ? middle : here).normalized();
        if (!inside.inside(next)) // the gradient runs along the surface up to the grid's steps
            inside.move(next, 0.5 * step);
        const double value = field.value(next);
        if (value > last) {
            line.push_back(next);
            p = next;
            last = value;
            continue;
        }
        ++stuck;
        inside.move(p, stuck * step);
        line.push_back(p);
        last = field.value(p);
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
    FibreField surface_field = solve_fibre_field(problem); // for colours; checks that there is a way, too
    model.notes.insert(model.notes.end(), surface_field.notes.begin(), surface_field.notes.end());
    model.field = surface_field.at_original(problem.surface->positions.size());
    model.seconds = {{"cut", surface_field.cut_seconds}, {"field", surface_field.field_seconds}};
    watch.lap();
    const MuscleInside inside(*problem.surface, problem.threads);
    const TriangleBvh insertions(problem.surface->positions,
                                 attached_triangles(problem, AttachmentKind::insertion));
    model.seconds.emplace_back("trees", watch.lap());
    const VolumeField field(problem, wanted_cells);
    model.seconds.emplace_back("volume field", watch.lap());

    FibreSet& fibres = model.rest;
    fibres.count = problem.count;
    fibres.segments = problem.segments;
    const auto per_fibre = fibres.points_per_fibre();
    fibres.points.resize(static_cast<std::size_t>(fibres.count) * per_fibre);
    const Points seeds = seeds_on(*problem.surface, attached_triangles(problem, AttachmentKind::origin),
                                  static_cast<std::size_t>(fibres.count));
    std::vector<char> far(seeds.size(), 0);
    parallel_for(problem.threads, seeds.size(), 2, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            Vec3 start = seeds[f];
            inside.move(start, 0.5 * field.step());
            Points line = trace(field, inside, start);
            const Vec3 last = insertions.closest(line.back()).point;
            far[f] = (last - line.back()).norm() > 4.0 * field.step() ? 1 : 0;
            line.insert(line.begin(), seeds[f]);
            line.push_back(last);
            resample(line, problem.segments, fibres.points.data() + f * per_fibre);
        }
    });
    ends_on_attachments(problem, fibres);
    smooth_fibres(fibres, smoothing_passes);
    if (const auto count = std::count(far.begin(), far.end(), 1); count > 0)
        model.notes.push_back(std::to_string(count) +
                              (count == 1
                                   ? " streamline ends short of the insertion and is led to it straight"
                                   : " streamlines end short of the insertion and are led to it straight"));
    model.seconds.emplace_back("streamlines", watch.lap());

    finish_fibres(problem, inside, model);
    return model;
}

} // namespace fascicle
