#include "reproduce/method_effort.hpp"

#include "fascicle/solver/soft_body_solver.hpp"

#include <algorithm>

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

/// What the short form sets: steps of a quarter of the way out, on a fine lattice, take some methods many passes.
struct ShortValue {
    const char* method;
    const char* key;
    double value;
};
const ShortValue short_values[] = {
    {"fem", "fem.spacing_mm", 40}, {"xpbd-tet", "xpbd-tet.spacing_mm", 20}, {"arap", "arap.alternations", 2}};

} // namespace

int frames_of(const std::string& method, bool is_short) {
    if (is_short)
        return short_frames;
    for (const Effort& effort : efforts)
        if (method == effort.method)
            return effort.frames;
    return 300;
}

void make_coarse(ParamSet& parameters, const std::string& method) {
    for (const ShortValue& row : short_values)
        if (method == row.method)
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
