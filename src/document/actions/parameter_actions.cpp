#include "fascicle/document/actions/parameter_actions.hpp"

namespace fascicle::actions {

namespace {

/// Equal in every value and in what counts as edited.
bool same(const ParamSet& a, const ParamSet& b) {
    if (!(a == b))
        return false;
    for (const ParamRow& row : a.table().rows())
        if (a.edited(row.key) != b.edited(row.key))
            return false;
    return true;
}

std::string label(const Document& document, std::string_view key) {
    const ParamRow* row = document.scene().parameters.table().find(key);
    return row == nullptr ? std::string(key) : row->label;
}

/// The new set becomes the scratch, and a step when it differs from the head.
bool replace(Document& document, ParamSet parameters, std::string name) {
    if (same(parameters, document.scene().parameters) && !document.has_uncommitted_edits())
        return false;
    document.edit().parameters = std::move(parameters);
    return document.commit(std::move(name));
}

} // namespace

void edit_parameter(Document& document, std::string_view key, double value) {
    ParamSet changed = document.scene().parameters;
    changed.set(key, value);
    if (!same(changed, document.scene().parameters))
        document.edit().parameters = std::move(changed);
}

bool commit_parameter(Document& document, std::string_view key) {
    if (document.scene().parameters == document.head()->parameters) {
        document.discard_edits();
        return false;
    }
    return document.commit("Set " + label(document, key));
}

bool set_parameter(Document& document, std::string_view key, double value) {
    ParamSet changed = document.scene().parameters;
    changed.set(key, value);
    return replace(document, std::move(changed), "Set " + label(document, key));
}

bool reset_parameter(Document& document, std::string_view key) {
    if (key == "solver.method") // its default decides what the other rows' defaults are
        return set_method(document, document.scene().parameters.table().find(key)->choices.front());
    ParamSet changed = document.scene().parameters;
    changed.reset(key);
    return replace(document, std::move(changed), "Reset " + label(document, key));
}

bool reset_all_parameters(Document& document) {
    ParamSet plain = document.scene().parameters;
    fascicle::set_method(
        plain, plain.table().find("solver.method")->choices.front()); // first: it decides the defaults
    for (const ParamRow& row : plain.table().rows())
        plain.reset(row.key);
    return replace(document, std::move(plain), "Reset all parameters");
}

bool set_method(Document& document, const std::string& method) {
    ParamSet changed = document.scene().parameters;
    fascicle::set_method(changed, method);
    return replace(document, std::move(changed), "Use method " + method);
}

bool set_parameters(Document& document, ParamSet parameters, std::string name) {
    return replace(document, std::move(parameters), std::move(name));
}

bool use_parameters(Document& document, const ParamSet& wanted, std::string name) {
    ParamSet changed = document.scene().parameters;
    fascicle::set_method(changed, wanted.get_choice("solver.method")); // first: it decides the defaults
    for (const ParamRow& row : changed.table().rows())
        if (row.key != "solver.method") {
            changed.reset(row.key);
            if (changed.get(row.key) != wanted.get(row.key))
                changed.set(row.key, wanted.get(row.key));
        }
    return replace(document, std::move(changed), std::move(name));
}

} // namespace fascicle::actions
