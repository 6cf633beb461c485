#include "reproduce/reproduce.hpp"

#include "fascicle/io/run_reader.hpp"
#include "fascicle/solver/soft_body_solver.hpp"
#include "reproduce/arm_shares.hpp"
#include "reproduce/experiment_scene.hpp"
#include "reproduce/findings.hpp"
#include "reproduce/method_effort.hpp"
#include "reproduce/run_pictures.hpp"
#include "reproduce/sensitivity.hpp"
#include "reproduce/speed.hpp"
#include "reproduce/surface_distance.hpp"
#include "reproduce/work_folder.hpp"

#include <algorithm>
#include <chrono>

namespace fascicle::reproduce {

namespace {

const char* const reference_method = "fem";
const char* const sensitivity_experiment = "iliacus";

double seconds_now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

bool among(const std::vector<std::string>& keys, const std::string& key) {
    return keys.empty() || std::find(keys.begin(), keys.end(), key) != keys.end();
}

/// Turns the progress of parts into that of the whole. Work is counted in units of about a second on two quiet cores: only for the bar.
class Meter {
public:
    Meter(const JobControl& control, double total) : control_(control), total_(std::max(total, 1e-9)) {}
    JobControl part(std::string name, double work) {
        JobControl inner;
        inner.cancel = control_.cancel;
        const double begin = done_;
        inner.report = [this, name = std::move(name), begin, work](std::string_view, double fraction) {
            if (control_.report)
                control_.report(name, std::min(1.0, (begin + work * fraction) / total_));
        };
        done_ += work;
        return inner;
    }

private:
    const JobControl& control_;
    double total_, done_ = 0;
};

struct Planned {
    ExperimentScene scene;
    ExperimentResult* result;
    std::vector<std::string> methods;
};

double work_of(const Planned& plan, const std::string& method, bool is_short) {
    const double triangles = plan.scene.scene.muscles.front().mesh->triangle_count();
    return 1.5 + frames_of(method, is_short) * triangles * 1.5e-6;
}

/// Scene of a method, in as many frames as it is given.
ScenePtr scene_for(const Planned& plan, const std::string& method, bool is_short) {
    auto scene = std::make_shared<Scene>(plan.scene.scene);
    set_method(scene->parameters, method);
    set_effort(scene->parameters, plan.result->experiment->key, method, is_short);
    scene->timeline = in_frames(scene->timeline, frames_of(method, is_short));
    return scene;
}

void run_method(const Planned& plan, MethodRun& row, const ReproduceOptions& options, const WorkFolder& work,
                const JobControl& control) {
    const int frames = frames_of(row.method, options.is_short);
    RunRequest request{scene_for(plan, row.method, options.is_short), plan.scene.notes,
                       std::max(1, frames / 6)};
    try {
        const WorkFolder::Made made = work.ensure(request, control);
        row.run = read_run(made.folder);
        row.reused = made.reused;
    } catch (const Error& error) {
        row.failure = error.what();
        return;
    }
    const RunReader reader(row.run.folder);
    const int flexed = static_cast<int>(row.run.flexed());
    row.flexed = reader.read_frame(flexed)->muscle_positions.front();
    if (options.pictures)
        draw_pictures(*reader.read_recording(), plan.scene.scene.line_muscles, *plan.result->experiment, row,
                      options.is_short);
}

void measure_distances(ExperimentResult& result, const Scene& scene) {
    const MethodRun* reference = result.run_of(reference_method);
    if (reference == nullptr || scene.timeline.hinge == std::nullopt)
        return;
    result.reference = reference->method;
    for (MethodRun& row : result.runs)
        if (row.done() && &row != reference)
            row.to_reference =
                surface_distance(*row.flexed, *reference->flexed, scene.muscles.front().mesh->triangles,
                                 millimetres_per_unit(scene.unit));
}

} // namespace

const char* to_text(Verdict verdict) {
    switch (verdict) {
    case Verdict::kept:
        return "kept";
    case Verdict::better:
        return "better";
    case Verdict::worse:
        return "worse";
    case Verdict::shown:
        return "shown";
    }
    return "shown";
}

const MethodRun* ExperimentResult::run_of(const std::string& method) const {
    for (const MethodRun& row : runs)
        if (row.method == method && row.done())
            return &row;
    return nullptr;
}

std::vector<std::string> part_keys() {
    std::vector<std::string> keys;
    for (const Experiment& e : experiments())
        keys.push_back(e.key);
    keys.push_back(sensitivity_key);
    keys.push_back(speed_key);
    return keys;
}

Results reproduce(const ReproduceOptions& options, const JobControl& control) {
    const double begin = seconds_now();
    Results results;
    results.is_short = options.is_short;
    const DataFiles data = options.data.empty() ? DataFiles() : DataFiles(options.data);
    results.data = options.data.empty() ? "no data: embedded scenes stand in" : "public data";
    for (const SolverMethod& method : solver_methods())
        if (among(options.methods, method.name))
            results.methods.push_back(method.name);

    const WorkFolder work(options.out / "work", program_identity(), options.threads);
    std::vector<Planned> plans;
    results.experiments.reserve(experiments().size()); // plans point into it
    double total = 0;
    ExperimentScene sensitivity_scene;
    const bool with_sensitivity = among(options.only, sensitivity_key);
    const bool with_speed = among(options.only, speed_key);
    for (const Experiment& e : experiments()) {
        const bool wanted = among(options.only, e.key);
        const bool measured = (with_sensitivity && e.key == sensitivity_experiment) ||
                              (with_speed && e.methods == MethodChoice::all);
        if (!wanted && !measured)
            continue;
        if (control.report)
            control.report("reading", 0);
        if (control.cancelled())
            throw Cancelled();
        ExperimentScene scene = make_experiment_scene(e, data, options.threads);
        results.inputs.insert(scene.inputs.begin(), scene.inputs.end());
        ExperimentResult result;
        result.experiment = &e;
        result.real = scene.real;
        result.missing = scene.missing;
        result.notes = scene.notes;
        if (e.key == sensitivity_experiment)
            sensitivity_scene = scene;
        if (!wanted) {
            if (scene.missing.empty())
                plans.push_back({std::move(scene), nullptr, {}});
            continue;
        }
        results.experiments.push_back(std::move(result));
        if (!scene.missing.empty())
            continue;
        Planned plan{std::move(scene), &results.experiments.back(), methods_of(e, options.methods)};
        if (plan.methods.empty())
            results.experiments.back().missing = "none of its methods was asked for";
        for (const std::string& method : plan.methods)
            total += work_of(plan, method, options.is_short);
        plans.push_back(std::move(plan));
    }
    const double sensitivity_work = with_sensitivity ? (options.is_short ? 3 : 60) : 0;
    const double speed_work = with_speed ? (options.is_short ? 1 : 20) : 0;
    Meter meter(control, total + sensitivity_work + speed_work);

    for (const Planned& plan : plans) {
        if (plan.result == nullptr)
            continue;
        ExperimentResult& result = *plan.result;
        for (const std::string& method : plan.methods) {
            MethodRun row;
            row.method = method;
            const JobControl inner =
                meter.part(result.experiment->key + ", " + method, work_of(plan, method, options.is_short));
            inner.checkpoint("", 0);
            run_method(plan, row, options, work, inner);
            result.runs.push_back(std::move(row));
        }
        measure_distances(result, plan.scene.scene);
        measure_arms(result);
        find_out(result);
    }
    if (with_sensitivity) {
        const JobControl inner = meter.part("sensitivity", sensitivity_work);
        if (sensitivity_scene.missing.empty() && !sensitivity_scene.scene.muscles.empty())
            results.sensitivity =
                measure_sensitivity(sensitivity_scene, sensitivity_experiment,
                                    {options.is_short ? 4 : 50, !options.is_short}, work, inner);
        else
            results.sensitivity.missing = sensitivity_scene.missing;
    } else {
        results.sensitivity.missing = "was not asked for";
    }
    if (with_speed) {
        std::vector<SpeedObject> objects;
        for (const Planned& plan : plans)
            if (plan.result == nullptr || plan.result->experiment->methods == MethodChoice::all)
                objects.push_back({plan.scene.scene.muscles.front().name, plan.scene.scene, plan.scene.real});
        std::vector<std::string> both;
        for (const std::string& method : {solver_methods().front().name, std::string("classic")})
            if (among(options.methods, method))
                both.push_back(method);
        results.speed = measure_speed(objects, both, options.threads, options.is_short ? 4 : 60, work.cache(),
                                      meter.part("speed", speed_work));
    }
    work.remove_outdated();
    results.seconds = seconds_now() - begin;
    return results;
}

} // namespace fascicle::reproduce
