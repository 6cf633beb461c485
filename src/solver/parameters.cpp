#include "fascicle/solver/parameters.hpp"

#include "fascicle/solver/soft_body_solver.hpp"

namespace fascicle {

namespace {

const char* const paper = "Cervenka & Kohout 2020";
const char* const xpbd_source = "Macklin, Mueller, Chentanez 2016";

std::vector<std::string> method_names() {
    std::vector<std::string> names;
    for (const SolverMethod& method : solver_methods())
        names.push_back(method.name);
    return names;
}

/// "xpbd, TEXT; classic, TEXT" of all methods.
template <class TextOf>
std::string of_methods(const char* before, const char* between, TextOf text_of) {
    std::string text;
    for (const SolverMethod& method : solver_methods())
        text += (text.empty() ? "" : between) + method.name + before + text_of(method);
    return text;
}

std::string method_lines() {
    return of_methods(": ", "; ", [](const SolverMethod& m) { return m.line; });
}

std::string method_passes() {
    return of_methods(" ", ", ",
                      [](const SolverMethod& m) { return std::to_string(m.passes) + " " + m.pass_means; });
}

std::vector<ParamRow> make_rows() {
    using K = ParamKind;
    std::vector<ParamRow> rows{
        {"solver.method", "Method", "1", K::choice, 0, static_cast<double>(method_names().size() - 1), 0,
         method_names(), method_lines() + ".", paper, false},
        {"solver.kernel",
         "Kernel",
         "1",
         K::choice,
         0,
         1,
         0,
         {"fast", "reference"},
         "Of xpbd. fast: floats in packets on all threads; reference: the same plainly, in double, to check "
         "against.",
         "docs/performance.md",
         true},
        {"solver.iterations",
         "Passes a frame",
         "1",
         K::integer,
         0,
         200,
         0,
         {},
         "Substeps or passes in a frame; 0 takes the method's own number: " + method_passes() + ".",
         paper,
         false},
        {"solver.coarse",
         "Coarse clusters",
         "1",
         K::integer,
         0,
         1000,
         100,
         {},
         "Of xpbd: clusters of vertices that a step before each sweep moves as wholes, for long waves; 0 "
         "leaves it out.",
         "docs/convergence.md",
         true},
        {"solver.frame_time",
         "Frame duration",
         "s",
         K::real,
         1e-4,
         1,
         1.0 / 60.0,
         {},
         "Time between two frames, for xpbd; classic takes 1 ms an inner loop as published.",
         xpbd_source,
         true},
        {"solver.stiffness",
         "Edge stiffness",
         "1",
         K::real,
         0,
         1,
         0.9,
         {},
         "How strongly edges keep their rest length; 1 is rigid. Read at a substep of 1 ms.",
         paper,
         false},
        {"solver.bending",
         "Bending stiffness",
         "1",
         K::real,
         0,
         1,
         0.3,
         {},
         "How strongly neighbouring triangles keep their dihedral angle. Read at a substep of 1 ms.",
         paper,
         false},
        {"solver.volume",
         "Volume",
         "1",
         K::choice,
         0,
         1,
         0,
         {"kept", "free"},
         "kept: the muscle encloses the same volume in every frame, as living muscle nearly does; free: "
         "nothing holds it.",
         "Cervenka & Kohout 2020, eq. 3; Mueller et al. 2007",
         false},
        {"solver.pressure",
         "Pressure",
         "1",
         K::real,
         0.5,
         2,
         1,
         {},
         "Wanted volume as a multiple of the rest volume.",
         paper,
         false},
        {"solver.anisotropy",
         "Anisotropy",
         "1",
         K::real,
         0,
         2,
         1,
         {},
         "Exponent a of k = (1 - |u.v|)^a: 0 is isotropic, larger lets edges along the fibres give more.",
         paper,
         false},
        {"solver.damping",
         "Damping",
         "1/s",
         K::real,
         0,
         1000,
         5,
         {},
         "Rate at which velocities die away; about 5 is critical for the slowest wave of a hip muscle.",
         paper,
         false},
        {"solver.tone",
         "Tone",
         "1",
         K::real,
         0,
         1,
         1,
         {},
         "How much of the slack the fibres take up by themselves when bones bring their ends together; 0 is "
         "a passive muscle.",
         "Nardinocchi & Teresi 2007; docs/tone.md",
         false},
        {"contact.offset_mm",
         "Contact offset",
         "mm",
         K::real,
         0,
         5,
         0.1,
         {},
         "Distance at which free vertices are held off a bone, beyond the error of its distance grid.",
         "methods notes, section 5.2",
         false},
        {"contact.friction",
         "Friction",
         "1",
         K::real,
         0,
         2,
         0,
         {},
         "Coulomb coefficient between muscle and bone; 0 slides freely.",
         "Macklin et al. 2014",
         false},
        {"contact.grid_mm",
         "Distance grid spacing",
         "mm",
         K::real,
         0.25,
         10,
         1,
         {},
         "Spacing of the bones' distance grids; finer is exacter and larger.",
         "measured",
         true},
        {"attachment.distance_mm",
         "Attachment distance",
         "mm",
         K::real,
         0,
         20,
         1,
         {},
         "Without outlines, muscle vertices nearer to a bone than this are attached (largest patch).",
         "measured",
         false},
        {"fibres.method",
         "Fibres",
         "1",
         K::choice,
         0,
         3,
         0,
         {"none", "kukacka", "chmd", "streamlines"},
         "How a muscle is decomposed into fibres: by a template, from superficial fibres, or by a field in "
         "its volume.",
         "Kohout & Kukacka 2014; Kohout & Cholt 2017; Choi & Blemker 2013",
         false},
        {"fibres.template",
         "Fibre template",
         "1",
         K::choice,
         0,
         3,
         0,
         {"parallel", "pennate", "curved", "fanned"},
         "How the fibres of kukacka run between the attachments.",
         "Blemker & Delp 2005",
         false},
        {"fibres.count",
         "Fibres a muscle",
         "1",
         K::integer,
         1,
         2000,
         100,
         {},
         "Number of fibres of each muscle.",
         "Modenese & Kohout 2020",
         false},
        {"fibres.segments",
         "Segments a fibre",
         "1",
         K::integer,
         1,
         200,
         15,
         {},
         "Straight segments that each fibre is made of.",
         "Modenese & Kohout 2020",
         false},
    };
    for (const SolverMethod& method : solver_methods())
        rows.insert(rows.end(), method.parameters.begin(), method.parameters.end());
    return rows;
}

/// A scene's come before the method's own.
void use_defaults(ParamSet& parameters, const std::string& method) {
    ParamSet::Defaults defaults = find_solver_method(method)->defaults;
    if (const ParamSet::Defaults* brought = parameters.kept_defaults(method))
        for (const auto& [key, value] : *brought)
            defaults[key] = value;
    parameters.set_defaults(defaults);
}

} // namespace

const ParamTable& parameter_table() {
    static const ParamTable table(make_rows());
    return table;
}

ParamSet default_parameters() {
    return ParamSet(parameter_table());
}

void set_method(ParamSet& parameters, const std::string& method) {
    const bool same = parameters.get_choice("solver.method") == method;
    parameters.set_text("solver.method", method);
    if (!same)
        use_defaults(parameters, method);
}

void bring_defaults(ParamSet& parameters, const ParamSet::Defaults& defaults) {
    const std::string& method = parameters.get_choice("solver.method");
    parameters.keep_defaults(method, defaults);
    use_defaults(parameters, method);
}

std::string unused_reason(const ParamSet& parameters, std::string_view key) {
    const SolverMethod& method = *find_solver_method(parameters.get_choice("solver.method"));
    for (const SolverMethod& other : solver_methods())
        if (other.name != method.name && key.starts_with(other.name + "."))
            return "only the method " + other.name + " uses it";
    for (const auto& [unused, reason] : method.unused)
        if (key == unused || (unused.ends_with('.') && key.starts_with(unused)))
            return reason;
    return {};
}

int passes_per_frame(const ParamSet& parameters) {
    const int set = parameters.get_int("solver.iterations");
    if (set > 0)
        return set;
    return find_solver_method(parameters.get_choice("solver.method"))->passes;
}

} // namespace fascicle
