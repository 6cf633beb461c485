#include "fascicle/document/actions/import_actions.hpp"

#include "fascicle/io/fibre_template_file.hpp"

namespace fascicle::actions {

namespace {

Muscle& muscle_at(Scene& scene, int index) {
    FASCICLE_ASSERT(index >= 0 && index < static_cast<int>(scene.muscles.size()));
    return scene.muscles[static_cast<std::size_t>(index)];
}

} // namespace

void keep_fibre_templates(Scene& scene) {
    if (scene.fibre_templates == nullptr) // part of the program: nobody owns them
        scene.fibre_templates = std::shared_ptr<const std::vector<FibreTemplate>>(
            std::shared_ptr<void>(), &built_in_fibre_templates());
}

void set_outlines(Document& document, int muscle, std::vector<AttachmentOutline> outlines,
                  const MeshSource& source) {
    Muscle& m = muscle_at(document.edit(), muscle);
    m.outlines = std::move(outlines);
    m.outline_files = {source};
    document.commit("Load outlines, " + m.name);
}

void set_surface_fibres(Document& document, int muscle, std::shared_ptr<const Polylines> fibres,
                        const MeshSource& source) {
    FASCICLE_ASSERT(fibres != nullptr);
    Muscle& m = muscle_at(document.edit(), muscle);
    m.surface_fibres = std::move(fibres);
    m.surface_fibres_source = source;
    document.commit("Load surface fibres, " + m.name);
}

void set_fibre_template(Document& document, int muscle, std::shared_ptr<const FibreTemplate> fibre_template,
                        const MeshSource& source) {
    FASCICLE_ASSERT(fibre_template != nullptr);
    Muscle& m = muscle_at(document.edit(), muscle);
    m.fibre_template = std::move(fibre_template);
    m.fibre_template_source = source;
    document.commit("Load fibre template, " + m.name);
}

void set_line_muscles(Document& document, std::shared_ptr<const LineMuscles> lines) {
    FASCICLE_ASSERT(lines != nullptr);
    document.edit().line_muscles = std::move(lines);
    document.commit("Load line muscles");
}

} // namespace fascicle::actions
