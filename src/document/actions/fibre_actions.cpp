#include "fascicle/document/actions/fibre_actions.hpp"

#include "fascicle/io/fibre_template_file.hpp"

namespace fascicle::actions {

namespace {

bool replace(Document& document, const ParamSet& parameters, const std::shared_ptr<const FibreTemplate>& own,
             const MeshSource& source, std::string name) {
    const Scene& scene = document.scene();
    bool changes = !(parameters == scene.parameters);
    for (const Muscle& muscle : scene.muscles)
        changes |= muscle.fibre_template != own;
    if (!changes)
        return false;
    Scene& edited = document.edit();
    edited.parameters = parameters;
    if (edited.fibre_templates == nullptr) // a scene that was made, not loaded
        edited.fibre_templates = std::shared_ptr<const std::vector<FibreTemplate>>(
            std::shared_ptr<void>(), &built_in_fibre_templates());
    for (Muscle& muscle : edited.muscles) {
        muscle.fibre_template = own;
        muscle.fibre_template_source = source;
    }
    return document.commit(std::move(name));
}

} // namespace

bool choose_fibre_template(Document& document, const std::string& key) {
    ParamSet parameters = document.scene().parameters;
    parameters.set_text("fibres.template", key);
    parameters.set_text("fibres.method", "kukacka");
    return replace(document, parameters, nullptr, {}, "Fibre template " + key);
}

bool use_fibre_template(Document& document, std::shared_ptr<const FibreTemplate> own,
                        const MeshSource& source) {
    ParamSet parameters = document.scene().parameters;
    parameters.set_text("fibres.method", "kukacka");
    std::string name = "Fibre template " + own->label;
    return replace(document, parameters, own, source, std::move(name));
}

} // namespace fascicle::actions
