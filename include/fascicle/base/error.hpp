#pragma once
// Errors that a user can cause. Every message is one line: what, where (file, line or byte), what was
// expected.

#include <stdexcept>
#include <string>

namespace fascicle {

/// Exit code a command ends with (docs/cli.md): the work failed, or the command line itself is wrong.
enum class ErrorKind { failed = 1, usage = 2 };

class Error : public std::runtime_error {
public:
    explicit Error(const std::string& message, ErrorKind kind = ErrorKind::failed)
        : std::runtime_error(message), kind_(kind) {}
    ErrorKind kind() const { return kind_; }

private:
    ErrorKind kind_;
};

/// Builds "where: what; expected ..." and throws it. `expected` may be empty.
/// Line breaks and other control characters in the parts are replaced, so that the message stays one line.
[[noreturn]] void throw_error(const std::string& where, const std::string& what,
                              const std::string& expected = {}, ErrorKind kind = ErrorKind::failed);

/// Thrown by long work when its JobControl asks it to stop. Not an error: the caller keeps what is done.
class Cancelled : public std::exception {
public:
    const char* what() const noexcept override { return "cancelled"; }
};

} // namespace fascicle
