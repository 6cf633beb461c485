#include "fascicle/document/actions/project_actions.hpp"

namespace fascicle::actions {

void replace_scene(Document& document, Scene scene, std::string step_name) {
    document.edit() = std::move(scene);
    document.commit(std::move(step_name));
}

} // namespace fascicle::actions
