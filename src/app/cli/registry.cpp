#include "app/cli/command.hpp"

namespace fascicle::app {

const std::vector<Command>& commands() {
    static const std::vector<Command> rows{
        {"scenes", "List the embedded scenes", "  fascicle scenes", add_scenes},
        {"info", "Tell what mesh files hold and what is wrong with them",
         "  fascicle info muscle.vtk bone.obj", add_info},
        {"parameters", "List every parameter of a simulation",
         "  fascicle parameters\n"
         "  fascicle parameters --markdown > docs/parameters.md",
         add_parameters},
    };
    return rows;
}

} // namespace fascicle::app
