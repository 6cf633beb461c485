#pragma once
// A subcommand of `fascicle`. One file per command and one row in registry.cpp.

#include <functional>
#include <vector>

namespace CLI {
class App;
}

namespace fascicle::app {

struct Command {
    const char* name;
    const char* line;     ///< one line for the list of commands
    const char* examples; ///< shown at the end of the command's help, one a line
    /// Adds the command's options to `app`; what it returns is called after parsing and gives the exit code.
    /// It may throw Error, whose kind tells the exit code.
    std::function<int()> (*add)(CLI::App& app);
};

/// In the order help shows them.
const std::vector<Command>& commands();

std::function<int()> add_scenes(CLI::App& app);
std::function<int()> add_info(CLI::App& app);
std::function<int()> add_convert(CLI::App& app);
std::function<int()> add_repair(CLI::App& app);
std::function<int()> add_simulate(CLI::App& app);
std::function<int()> add_export(CLI::App& app);
std::function<int()> add_fibres(CLI::App& app);
std::function<int()> add_render(CLI::App& app);
std::function<int()> add_report(CLI::App& app);
std::function<int()> add_lines(CLI::App& app);
std::function<int()> add_compare(CLI::App& app);
std::function<int()> add_bench(CLI::App& app);
std::function<int()> add_reproduce(CLI::App& app);
std::function<int()> add_parameters(CLI::App& app);
std::function<int()> add_templates(CLI::App& app);

} // namespace fascicle::app
