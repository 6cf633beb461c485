#include "reproduce/method_effort.hpp"

#include "fascicle/solver/soft_body_solver.hpp"

#include <algorithm>
#include <span>

namespace fascicle::reproduce {

namespace {

/// Methods that seek a shape at rest in every frame, and take long for it: the same motion in fewer, larger steps. Methods that step through
/// time keep all frames, since their result depends on the speed.
struct Effort {
    const char* method;
    int frames;
};
const Effort efforts[] = {{"fem", 60}, {"arap", 150}};

const int short_frames = 12;

/// What an experiment (nullptr: every one) sets for a method.
struct EffortValue {
    const char* experiment;
    const char* method;
    const char* key;
    double value;
};
/// In the short form steps of a quarter of the way out, on a fine lattice, would take some methods many passes.
const EffortValue short_values[] = {{nullptr, "fem", "fem.spacing_mm", 40},
                                    {nullptr, "xpbd-tet", "xpbd-tet.spacing_mm", 20},
                                    {nullptr, "arap", "arap.alternations", 2}};
/// Where fem finds no equilibrium any longer (docs/rivals/fem.md) every frame takes it 10 s on the lattice of the others (10 mm).
const EffortValue full_values[] = {{"squish-box", "fem", "fem.spacing_mm", 14}};

} // namespace

int frames_of(const std::string& method, bool is_short) {
    if (is_short)
        return short_frames;
    for (const Effort& effort : efforts)
        if (method == effort.method)
            return effort.frames;
    return 300;
}

void set_effort(ParamSet& parameters, const std::string& experiment, const std::string& method,
                bool is_short) {
    for (const EffortValue& row :
         is_short ? std::span<const EffortValue>(short_values) : std::span<const EffortValue>(full_values))
        if (method == row.method && (row.experiment == nullptr || experiment == row.experiment))
            parameters.set(row.key, row.value);
}

std::vector<std::string> methods_of(const Experiment& experiment, const std::vector<std::string>& wanted) {
    std::vector<std::string> names;
    for (const SolverMethod& method : solver_methods()) {
        const bool chosen =
            wanted.empty() || std::find(wanted.begin(), wanted.end(), method.name) != wanted.end();
        const bool runs =
            experiment.methods == MethodChoice::all ||
            (experiment.methods == MethodChoice::first && &method == &solver_methods().front()) ||
            (experiment.methods == MethodChoice::published && method.name == "classic");
        if (chosen && runs)
            names.push_back(method.name);
    }
    return names;
}

} // namespace fascicle::reproduce
