#include "editor/param_effect.hpp"

#include "fascicle/solver/parameters.hpp"

#include <algorithm>

namespace fascicle::editor {

std::string no_effect_reason(const Scene& scene, const ParamRow& row) {
    const ParamSet& parameters = scene.parameters;
    const std::string& fibres = parameters.get_choice("fibres.method");
    const std::string& key = row.key;
    if (std::string reason = unused_reason(parameters, key); !reason.empty())
        return reason;
    if (key == "solver.pressure" && parameters.get_choice("solver.volume") == "free")
        return "the volume is free";
    if (fibres == "none" && (key == "fibres.count" || key == "fibres.segments"))
        return "no fibres are made";
    if (key == "fibres.template" && fibres != "kukacka")
        return "only fibres by kukacka follow a template";
    return {};
}

bool of_another_method(const Scene& scene, const ParamRow& row) {
    const std::string owner = row.key.substr(0, row.key.find('.'));
    const ParamRow& methods = *scene.parameters.table().find("solver.method");
    return owner != scene.parameters.get_choice("solver.method") &&
           std::find(methods.choices.begin(), methods.choices.end(), owner) != methods.choices.end();
}

} // namespace fascicle::editor
