// CHMD (Kohout & Cholt 2017, "Automatic reconstruction of the muscle architecture from the superficial layer fibres
// data"): the given fibres are splined into a superficial layer, copied in layers through the thickness, and led to the
// attachments.
#include "finish.hpp"

#include "fascicle/anatomy/fibre_methods.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/base/parallel.hpp"
#include "fascicle/geometry/volume.hpp"

#include <chrono>
#include <cstdio>

namespace fascicle {

namespace {

using namespace chmd;

void require_whole_number(const FibreProblem& problem, const char* what, int value, int most) {
    if (value < 1 || value > most)
        throw_error(problem.muscle, std::string(what) + " is " + std::to_string(value),
                    "1 to " + std::to_string(most));
}

void require_patches(const FibreProblem& problem) {
    bool found[2] = {false, false};
    for (const AttachmentPatch& patch : problem.patches) {
        const std::string who = patch.name.empty() ? "an attachment" : patch.name;
        if (patch.kind == AttachmentKind::unknown)
            throw_error(problem.muscle, who + " is neither origin nor insertion", "one of the two");
        if (patch.vertices.empty())
            throw_error(problem.muscle, who + " holds no vertex of the muscle",
                        "an attachment that touches the muscle");
        for (const int v : patch.vertices)
            if (v < 0 || v >= problem.surface->vertex_count())
                throw_error(problem.muscle, who + " uses vertex " + std::to_string(v),
                            "0 to " + std::to_string(problem.surface->vertex_count() - 1));
        found[patch.kind == AttachmentKind::insertion ? 1 : 0] = true;
    }
    for (const int k : {0, 1})
        if (!found[k])
            throw_error(problem.muscle,
                        std::string("no ") + (k == 0 ? "origin" : "insertion") + " is attached",
                        "at least one origin and one insertion, which the fibres run between");
}

void require_problem(const FibreProblem& problem) {
    require_whole_number(problem, "the number of fibres", problem.count, 2000);
    require_whole_number(problem, "the number of segments", problem.segments, 200);
    if (problem.surface == nullptr || problem.surface->triangles.empty())
        throw_error(problem.muscle, "the muscle has no surface", "a closed triangle surface");
    for (const Vec3& p : problem.surface->positions)
        if (!p.allFinite())
            throw_error(problem.muscle, "a vertex is not finite", "finite coordinates");
    if (const std::size_t open = problem.topology->boundary_edges().size(); open > 0)
        throw_error(problem.muscle, "the surface has holes (" + std::to_string(open) + " border edges)",
                    "a closed surface, so that its thickness is known");
    if (!(signed_volume(problem.surface->positions, problem.surface->triangles) > 0.0))
        throw_error(problem.muscle, "the surface is inside out or encloses nothing",
                    "triangles counter-clockwise seen from outside");
    require_patches(problem);
}

class StageClock {
public:
    explicit StageClock(FibreModel& model) : model_(model) {}
    void end(const char* stage) {
        const auto now = std::chrono::steady_clock::now();
        model_.seconds.emplace_back(stage, std::chrono::duration<double>(now - last_).count());
        last_ = now;
    }

private:
    FibreModel& model_;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

} // namespace

FibreModel decompose_chmd(const FibreProblem& problem) {
    require_problem(problem);
    FibreModel model;
    StageClock clock(model);
    const SolidQuery solid(*problem.surface);
    const PatchSurface origin = make_patch_surface(problem, AttachmentKind::origin);
    const PatchSurface insertion = make_patch_surface(problem, AttachmentKind::insertion);
    clock.end("trees");
    const ControlFibres control = order_control_fibres(problem, solid, origin, insertion);
    const Rows rows(problem, solid, control);
    clock.end("rows");
    const std::vector<Strand> strands = make_strands(problem, rows);
    clock.end("layers");
    const StrandEnds from = assign_ends(problem, rows, strands, origin, true);
    const StrandEnds to = assign_ends(problem, rows, strands, insertion, false);
    clock.end("ends");

    FibreSet& fibres = model.rest;
    fibres.count = problem.count;
    fibres.segments = problem.segments;
    fibres.points.resize(strands.size() * fibres.points_per_fibre());
    parallel_for(problem.threads, strands.size(), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            const Points fibre = finish_fibre(*problem.surface, solid, strands[f], from.trim[f], to.trim[f],
                                              from.targets[f], to.targets[f], problem.segments);
            std::copy(fibre.begin(), fibre.end(),
                      fibres.points.begin() + static_cast<std::ptrdiff_t>(f * fibres.points_per_fibre()));
        }
    });
    clock.end("finish");
    model.carrier = bind_inside(*problem.surface, *problem.topology, fibres.points, problem.threads);
    clock.end("carrier");
    if (control.farthest * problem.unit_mm > 5.0) {
        char text[80];
        std::snprintf(text, sizeof text,
                      "surface fibres lie up to %.1f mm from the surface and were laid onto it",
                      control.farthest * problem.unit_mm);
        model.notes.push_back(text);
    }
    for (const bool at_origin : {true, false})
        if (const int heads = rows.head(rows.spans(), at_origin) + 1; heads > 1)
            model.notes.push_back(std::to_string(heads) + " heads at the " +
                                  (at_origin ? "origin" : "insertion"));
    return model;
}

} // namespace fascicle
