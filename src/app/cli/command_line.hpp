#pragma once

namespace fascicle::app {

/// The whole program `fascicle`: parses, runs one command, and returns the exit code: 0 done, 1 the work
/// failed, 2 the command line is wrong. Every error is exactly one line on standard error. Throws nothing.
int run_command_line(int argc, char** argv);

} // namespace fascicle::app
