#include "reproduce/sensitivity.hpp"

#include "fascicle/geometry/bvh.hpp"
#include "fascicle/geometry/remesh.hpp"
#include "fascicle/solver/soft_body_solver.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fascicle::reproduce {

namespace {

struct Quantity {
    const char* key;   ///< of metric_table()
    const char* label; ///< with its unit
    double factor;     ///< from the table's unit
    double noise;      ///< changes below this are none
};
const Quantity quantities[] = {
    {"volume_ratio", "volume ratio", 1, 1e-4},
    {"edge_extension_mean", "edge extension, mean", 1, 0.002},
    {"edge_extension_p99", "edge extension, 99th percentile", 1, 0.01},
    {"dihedral_change_mean_rad", "dihedral change, mean [deg]", 180 / std::numbers::pi, 0.3},
    {"displacement_mean_mm", "displacement, mean [mm]", 1, 0.1},
    {"fibre_length_mean_mm", "fibre length, mean [mm]", 1, 0.2},
};

struct Variant {
    const char* key;
    double triangles, passes; ///< factors
    bool remesh;
    int base; ///< place of the variant that this one is held against
};
/// A remeshed surface has even triangles, so that means over vertices and edges weigh it otherwise: finer and coarser ones are held
/// against an even one of the same number.
const Variant variants[] = {{"as given", 1, 1, false, 0},
                            {"remeshed evenly", 1, 1, true, 0},
                            {"half the triangles", 0.5, 1, true, 1},
                            {"twice the triangles", 2, 1, true, 1},
                            {"half the passes", 1, 0.5, false, 0},
                            {"twice the passes", 1, 2, false, 0}};
const double lowered = 0.8; ///< what a parameter is multiplied by

/// The way out alone, in so many frames: the paper's motion is a third of it out.
Timeline way_out(const Timeline& timeline, int frames) {
    Timeline result = in_frames(timeline, 3 * frames);
    result.last_frame = frames;
    return result;
}

/// Real parameters of the solver that act on the method, and are not 0: lowering these changes something.
std::vector<std::string> tried_parameters(const ParamSet& parameters) {
    std::vector<std::string> keys;
    for (const ParamRow& row : parameters.table().rows())
        if (row.kind == ParamKind::real && row.key.starts_with("solver.") && parameters.get(row.key) != 0 &&
            lowered * parameters.get(row.key) >= row.minimum && unused_reason(parameters, row.key).empty())
            keys.push_back(row.key);
    return keys;
}

} // namespace

bool effects_differ(double a, double b, double noise) {
    const double apart = std::abs(a - b);
    return apart > noise && apart > 0.25 * std::max(std::abs(a), std::abs(b));
}

Muscle remeshed(const Muscle& muscle, int triangles) {
    const TriMesh& old = *muscle.mesh;
    const TriangleBvh tree(old);
    RemeshOptions options;
    options.triangles = triangles;
    options.project = [&tree](const Vec3& p) { return tree.closest(p).point; };
    Muscle result = muscle;
    auto mesh = std::make_shared<TriMesh>(remesh(old, options));
    for (std::size_t i = 0; i < result.attachments.size(); ++i) {
        std::vector<char> attached(old.positions.size(), 0);
        for (const int v : muscle.attachments[i].vertices)
            attached[static_cast<std::size_t>(v)] = 1;
        std::vector<int>& vertices = result.attachments[i].vertices;
        vertices.clear();
        for (std::size_t v = 0; v < mesh->positions.size(); ++v) {
            const Tri& t = old.triangles[static_cast<std::size_t>(tree.closest(mesh->positions[v]).triangle)];
            if (std::all_of(t.begin(), t.end(),
                            [&](int c) { return attached[static_cast<std::size_t>(c)] != 0; }))
                vertices.push_back(static_cast<int>(v));
        }
    }
    result.mesh = std::move(mesh);
    return result;
}

SensitivityResult measure_sensitivity(const ExperimentScene& base, const std::string& experiment,
                                      const SensitivityOptions& options, const WorkFolder& work,
                                      const JobControl& control) {
    SensitivityResult result;
    result.experiment = experiment;
    result.real = base.real;
    Scene scene = base.scene;
    set_method(scene.parameters, solver_methods().front().name);
    result.method = scene.parameters.get_choice("solver.method");
    scene.timeline = way_out(scene.timeline, options.frames);
    for (const Quantity& q : quantities)
        result.quantities.push_back(q.label);
    if (options.with_parameters)
        result.parameters = tried_parameters(scene.parameters);
    const int passes = passes_per_frame(scene.parameters);
    const int triangles = scene.muscles.front().mesh->triangle_count();
    const std::size_t runs = std::size(variants) * (1 + result.parameters.size());
    std::size_t run = 0;

    const auto values_of = [&](const Scene& wanted) {
        RunRequest request{std::make_shared<const Scene>(wanted), {}, 0};
        JobControl inner = control;
        inner.report = [&](std::string_view, double fraction) {
            if (control.report)
                control.report("sensitivity",
                               (static_cast<double>(run) + fraction) / static_cast<double>(runs));
        };
        const RunData data = read_run(work.ensure(request, inner).folder);
        ++run;
        std::vector<double> values;
        for (const Quantity& q : quantities)
            values.push_back(q.factor * data.metric(q.key).back());
        return values;
    };
    for (const Variant& v : variants) {
        SensitivityVariant row;
        row.key = v.key;
        row.base = static_cast<std::size_t>(v.base);
        Scene varied = scene;
        if (v.remesh)
            varied.muscles.front() =
                remeshed(scene.muscles.front(), static_cast<int>(std::lround(v.triangles * triangles)));
        row.triangles = static_cast<std::size_t>(varied.muscles.front().mesh->triangle_count());
        row.passes = std::max(1, static_cast<int>(std::lround(v.passes * passes)));
        varied.parameters.set("solver.iterations", row.passes);
        try {
            row.values = values_of(varied);
            for (const std::string& key : result.parameters) {
                Scene changed = varied;
                changed.parameters.set(key, lowered * varied.parameters.get(key));
                std::vector<double> values = values_of(changed);
                for (std::size_t q = 0; q < values.size(); ++q)
                    values[q] -= row.values[q];
                row.effects.push_back(std::move(values));
            }
        } catch (const Error& error) {
            row.failure = error.what();
        }
        result.variants.push_back(std::move(row));
    }
    for (std::size_t p = 0; p < result.parameters.size(); ++p)
        for (const SensitivityVariant& v : result.variants)
            for (std::size_t q = 0; q < result.quantities.size(); ++q) {
                const SensitivityVariant& held = result.variants[v.base];
                if (&v != &result.variants[1] && p < v.effects.size() && p < held.effects.size() &&
                    effects_differ(v.effects[p][q], held.effects[p][q], quantities[q].noise))
                    result.dependences.push_back({result.parameters[p], result.quantities[q], v.key,
                                                  v.effects[p][q], held.effects[p][q]});
            }
    return result;
}

} // namespace fascicle::reproduce
