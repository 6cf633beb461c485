#include "fascicle/anatomy/fibre_methods.hpp"

#include "anatomy/fibres/contour_map.hpp"
#include "anatomy/fibres/fibre_field.hpp"
#include "anatomy/fibres/fibre_finish.hpp"
#include "anatomy/fibres/template_fit.hpp"
#include "fascicle/base/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle {

namespace {

constexpr int smoothing_passes = 5;
/// A curved template needs levels between its points as well.
constexpr int fewest_levels = 24;

bool straight(const FibreTemplate& fibre_template) {
    for (const double r : {0.0, 1.0})
        for (const double s : {0.0, 0.3, 0.7, 1.0})
            for (const double t : {0.0, 0.3, 0.6, 1.0})
                if (std::abs(fibre_template.point(r, s, t).y() - t) > 1e-9)
                    return false;
    return true;
}

} // namespace

FibreModel decompose_kukacka(const FibreProblem& given) {
    FibreModel model;
    Stopwatch watch;
    const FibreProblem problem = checked_problem(given, model.notes);
    const FibreTemplate& fibre_template =
        problem.fibre_template != nullptr ? *problem.fibre_template : parallel_template();
    check_template(fibre_template, fibre_error_place(problem) + ": template '" + fibre_template.key + "'");
    FibreField field = solve_fibre_field(problem);
    model.notes.insert(model.notes.end(), field.notes.begin(), field.notes.end());
    model.field = field.at_original(problem.surface->positions.size());
    watch.lap();
    const MuscleInside inside(*problem.surface, problem.threads);
    const double trees = watch.lap();
    const int levels =
        straight(fibre_template) ? problem.segments : std::max(problem.segments, fewest_levels);
    const ContourMap map(field.surface.mesh, field.topology, field.values, levels,
                         fit_template(problem, fibre_template));
    const double isolines = watch.lap();

    const std::vector<Vec2> seeds = fibre_seeds(problem.count);
    FibreSet& fibres = model.rest;
    fibres.count = problem.count;
    fibres.segments = problem.segments;
    fibres.points.resize(seeds.size() * fibres.points_per_fibre());
    parallel_for(problem.threads, seeds.size(), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            const Points cube = fibre_in_cube(fibre_template, seeds[f].y(), seeds[f].x(), problem.segments);
            for (std::size_t j = 0; j < cube.size(); ++j)
                fibres.points[f * cube.size() + j] = map(cube[j]);
        }
    });
    ends_on_attachments(problem, fibres);
    smooth_fibres(fibres, smoothing_passes);
    const double mapping = watch.lap();
    model.seconds = {{"cut", field.cut_seconds},
                     {"field", field.field_seconds},
                     {"trees", trees},
                     {"isolines", isolines},
                     {"mapping", mapping}};
    if (map.empty_levels() > 0)
        model.notes.push_back(
            std::to_string(map.empty_levels()) +
            " cross-sections are single points: the attachments leave no room between them");
    finish_fibres(problem, inside, model);
    return model;
}

} // namespace fascicle
