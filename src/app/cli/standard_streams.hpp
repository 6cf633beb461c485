#pragma once
// The three streams that a program is started with, whatever they are.

namespace fascicle::app {

/// Streams that are closed are opened on something that can be neither read nor written, so that no file of ours gets their
/// numbers and with them what is meant for the screen. Writing into a pipe that nobody reads becomes an error instead of
/// the end of the program: files under way are finished.
void secure_standard_streams();

/// Writes out what std::cout holds. False when it could not be written. A reader that has gone (`| head -1`) has what it
/// wanted: no failure.
bool flush_standard_output();

} // namespace fascicle::app
