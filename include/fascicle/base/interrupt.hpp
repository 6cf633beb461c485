#pragma once
// The user's wish to stop (Ctrl-C, SIGTERM) as a flag. What is POSIX about it stays in interrupt.cpp.

#include <atomic>

namespace fascicle {

/// From now on the first SIGINT or SIGTERM sets the flag; a second one ends the program at once, as if
/// nothing had been installed. Returns the flag; calling again is harmless.
const std::atomic<bool>& watch_interrupts();

/// A write past the file size limit of the shell (`ulimit -f`) becomes a failed write with a reason instead
/// of a killed program.
void report_file_size_limit();

} // namespace fascicle
