// The command line: all commands' options, up to the work itself.

#include "app/cli/command_line.hpp"
#include "fuzz/check.hpp"
#include "fuzz/targets.hpp"
#include "fuzz/words.hpp"

namespace fascicle::fuzz {
namespace {

/// A word a line.
void fuzz_command_line(std::string_view bytes) {
    std::vector<std::string> words = words_of(bytes);
    words.insert(words.begin(), "fascicle");
    std::vector<char*> argv;
    for (std::string& word : words)
        argv.push_back(word.data());
    argv.push_back(nullptr);
    check_usage(
        [&] { FUZZ_CHECK(app::parse_command_line(static_cast<int>(words.size()), argv.data()) != nullptr); });
}

} // namespace

std::vector<Target> command_line_targets() {
    return {
        {"command_line", fuzz_command_line, 512, "command_line", "command_line", 4000, 4 * MB},
    };
}

} // namespace fascicle::fuzz
