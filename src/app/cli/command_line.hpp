#pragma once

#include <functional>

namespace fascicle::app {

/// What the arguments ask for, as a function that does it and returns the exit code; nothing is done or read before
/// it is called. Error (usage) when they are wrong in a way that shows without looking at any file.
std::function<int()> parse_command_line(int argc, char** argv);

/// The whole program `fascicle`: parses, runs one command, and returns the exit code: 0 done, 1 the work
/// failed, 2 the command line is wrong. Every error is exactly one line on standard error. Throws nothing.
int run_command_line(int argc, char** argv);

} // namespace fascicle::app
