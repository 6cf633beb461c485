#include "app/cli/command.hpp"

namespace fascicle::app {

const std::vector<Command>& commands() {
    static const std::vector<Command> rows{
        {"parameters", "List every parameter of a simulation",
         "  fascicle parameters\n"
         "  fascicle parameters --markdown > docs/parameters.md",
         add_parameters},
    };
    return rows;
}

} // namespace fascicle::app
