#include "app/cli/command_line.hpp"

#include "app/cli/command.hpp"
#include "app/cli/standard_streams.hpp"
#include "fascicle/base/build_info.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/base/interrupt.hpp"
#include "fascicle/base/suggest.hpp"
#include "fascicle/base/text.hpp"

#include <CLI/CLI.hpp>
#include <iostream>

namespace fascicle::app {

namespace {

const char* const closing = "Exit code: 0 done, 1 the work failed, 2 the command line is wrong.\n"
                            "'fascicle COMMAND --help' shows a command's options and examples.\n\n"
                            "Examples:\n"
                            "  fascicle scenes\n"
                            "  fascicle simulate --scene hip --export vtp,png --out out/hip\n"
                            "  fascicle render out/hip --frame 100 --size 1200x800 --out hip.png";

struct Added {
    CLI::App* app;
    std::function<int()> run;
};

/// The command that is asked for, with its options; when there is no such one all of them, for the list in the help.
std::vector<Added> add_commands(CLI::App& app, std::string_view asked_for) {
    std::vector<Added> added;
    const bool known = std::any_of(commands().begin(), commands().end(),
                                   [&](const Command& command) { return command.name == asked_for; });
    for (const Command& command : commands()) {
        if (known && command.name != asked_for)
            continue;
        CLI::App* sub = app.add_subcommand(command.name, command.line);
        if (command.name != asked_for)
            continue;
        sub->allow_extras(); // what is left over is reported by check_leftovers, with a suggestion
        sub->footer(std::string("Examples:\n") + command.examples);
        added.push_back({sub, command.add(*sub)});
    }
    return added;
}

std::vector<std::string> option_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_lnames())
            names.push_back("--" + name);
    return names;
}

/// Error (usage) for the first argument that is no option or operand of the command.
void check_leftovers(const CLI::App& app, const std::string& command) {
    std::vector<std::string> left = app.remaining();
    // "--": what follows is no option, whatever it begins with.
    const auto end_of_options = std::find(left.begin(), left.end(), "--");
    const auto options_left = end_of_options - left.begin();
    if (end_of_options != left.end())
        left.erase(end_of_options);
    if (left.empty())
        return;
    const auto option = std::find_if(left.begin(), left.begin() + options_left, [](const std::string& word) {
        return word.size() > 1 && word[0] == '-';
    });
    if (option == left.begin() + options_left)
        throw_error(command, "unexpected argument '" + left.front() + "'", "only options here",
                    ErrorKind::usage);
    const std::string word = option->substr(0, option->find('='));
    throw_error(command, "unknown option '" + word + "'" + did_you_mean(word, option_names(app)), {},
                ErrorKind::usage);
}

/// Error (usage) unless the first argument is an option of the program or a command.
void check_command(int argc, char** argv) {
    std::vector<std::string> names;
    std::string list;
    for (const Command& command : commands()) {
        names.emplace_back(command.name);
        list += (list.empty() ? "" : ", ") + names.back();
    }
    const std::string word = argc > 1 ? argv[1] : "";
    if (word.empty())
        throw_error({}, "no command", "one of " + list + ", or --help", ErrorKind::usage);
    if (word == "--help" || word == "-h" || word == "--version")
        return;
    if (word[0] == '-')
        throw_error({}, "unknown option '" + word + "'" + did_you_mean(word, {"--help", "--version"}),
                    "a command or --help", ErrorKind::usage);
    if (std::find(names.begin(), names.end(), word) == names.end())
        throw_error({}, "unknown command '" + word + "'" + did_you_mean(word, names), "one of " + list,
                    ErrorKind::usage);
}

int complain(const std::string& message, int code) {
    std::cout.flush();
    std::cerr << "fascicle: " << one_line(message) << std::endl;
    return code;
}

} // namespace

std::function<int()> parse_command_line(int argc, char** argv) {
    const auto app =
        std::make_shared<CLI::App>("Deforms skeletal muscles with position-based dynamics.", "fascicle");
    app->get_formatter()->column_width(32);
    app->set_version_flag("--version", std::string("fascicle ") + program_version(),
                          "Print the version and exit");
    app->footer(closing);
    app->require_subcommand(0, 1); // the name of another one is an operand
    const std::vector<Added> added = add_commands(*app, argc > 1 ? argv[1] : "");
    check_command(argc, argv);
    try {
        app->parse(argc, argv);
    } catch (const CLI::Success& asked) { // --help, --version
        return [app, asked] { return app->exit(asked); };
    } catch (const CLI::ParseError& error) {
        throw_error(argv[1], error.what(), {}, ErrorKind::usage);
    }
    for (const Added& command : added)
        if (command.app->parsed()) {
            check_leftovers(*command.app, command.app->get_name());
            return command.run;
        }
    return [] { return 0; };
}

int run_command_line(int argc, char** argv) {
    try {
        secure_standard_streams();
        report_file_size_limit();
        const int code = parse_command_line(argc, argv)();
        if (!flush_standard_output())
            throw_error("standard output", "cannot write");
        return code;
    } catch (const Error& error) {
        return complain(error.what(), static_cast<int>(error.kind()));
    } catch (const Cancelled&) {
        return complain("cancelled; nothing was written", 1);
    } catch (const std::bad_alloc&) {
        return complain("not enough memory", 1);
    } catch (const std::exception& error) {
        return complain(error.what(), 1);
    }
}

} // namespace fascicle::app
