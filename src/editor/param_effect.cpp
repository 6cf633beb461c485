#include "editor/param_effect.hpp"

#include "fascicle/solver/soft_body_solver.hpp"

namespace fascicle::editor {

std::string no_effect_reason(const Scene& scene, const ParamRow& row) {
    const ParamSet& parameters = scene.parameters;
    const SolverMethod& method = *find_solver_method(parameters.get_choice("solver.method"));
    const std::string& fibres = parameters.get_choice("fibres.method");
    const std::string& key = row.key;
    for (const SolverMethod& other : solver_methods())
        if (other.name != method.name && key.starts_with(other.name + "."))
            return "only the method " + other.name + " uses it";
    for (const auto& [unused, reason] : method.unused)
        if (key == unused || (unused.ends_with(".") && key.starts_with(unused)))
            return reason;
    if (key == "solver.pressure" && parameters.get_choice("solver.volume") == "free")
        return "the volume is free";
    if (fibres == "none" && (key == "fibres.count" || key == "fibres.segments"))
        return "no fibres are made";
    if (key == "fibres.template" && fibres != "kukacka")
        return "only fibres by kukacka follow a template";
    return {};
}

} // namespace fascicle::editor
