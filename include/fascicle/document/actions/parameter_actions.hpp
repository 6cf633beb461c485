#pragma once
// Changes of a scene's parameters. Errors (usage) name the key; the document is then as it was.

#include "fascicle/document/document.hpp"

namespace fascicle::actions {

/// Sets a value on the scratch, for as long as a slider is held; commit_parameter() ends the drag.
void edit_parameter(Document& document, std::string_view key, double value);
/// Makes the drag one step. A drag that came back to where it began is no step (false).
bool commit_parameter(Document& document, std::string_view key);

/// One step each; false, and no step, when nothing changes.
bool set_parameter(Document& document, std::string_view key, double value);
bool reset_parameter(Document& document, std::string_view key);
bool reset_all_parameters(Document& document);
/// The whole set at once, as one step with this name: a preset, a lesson's values.
bool set_parameters(Document& document, ParamSet parameters, std::string name);
/// Switches between xpbd and classic; values that were not edited follow the method's defaults.
bool set_method(Document& document, const std::string& method);
/// All values of another set at once, such as an earlier run's; those that are the method's defaults do not count as edited. `name`: of
/// the step.
bool use_parameters(Document& document, const ParamSet& wanted, std::string name);

} // namespace fascicle::actions
