#include "editor/param_effect.hpp"

namespace fascicle::editor {

std::string no_effect_reason(const Scene& scene, const ParamRow& row) {
    const ParamSet& parameters = scene.parameters;
    const bool classic = parameters.get_choice("solver.method") == "classic";
    const std::string& fibres = parameters.get_choice("fibres.method");
    const std::string& key = row.key;
    if (key.starts_with("classic.") && !classic)
        return "only the method classic uses it";
    if (classic) {
        if (key == "solver.frame_time")
            return "classic takes 1 ms an inner loop";
        if (key == "solver.kernel" || key == "solver.coarse" || key == "solver.tone")
            return "only the method xpbd uses it";
        if (key.starts_with("contact."))
            return "classic stops a vertex where it is inside a bone, without distance grids";
        if (key == "attachment.distance_mm")
            return "classic fixes what lies inside a bone at the start";
    }
    if (key == "solver.pressure" && parameters.get_choice("solver.volume") == "free")
        return "the volume is free";
    if (fibres == "none" && (key == "fibres.count" || key == "fibres.segments"))
        return "no fibres are made";
    if (key == "fibres.template" && fibres != "kukacka")
        return "only fibres by kukacka follow a template";
    return {};
}

} // namespace fascicle::editor
