#pragma once
// Which template the fibres of muscles follow.

#include "fascicle/document/document.hpp"

namespace fascicle::actions {

/// Fibres by a built-in template: sets fibres.template and fibres.method=kukacka, and takes the muscles' own templates
/// away. One undo step; false, and no step, when nothing changes. Error (usage) for an unknown key.
bool choose_fibre_template(Document& document, const std::string& key);

/// The same with a template read from a file, for every muscle.
bool use_fibre_template(Document& document, std::shared_ptr<const FibreTemplate> own,
                        const MeshSource& source);

} // namespace fascicle::actions
