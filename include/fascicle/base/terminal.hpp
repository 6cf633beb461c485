#pragma once
// What is known about the terminal that standard error goes to. What is POSIX about it stays in terminal.cpp.

namespace fascicle {

/// False when standard error is a file or a pipe.
bool stderr_is_terminal();

/// Width of that terminal in characters; 80 when it does not tell.
int terminal_columns();

} // namespace fascicle
