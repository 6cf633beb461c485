#include "fascicle/base/error.hpp"

#include "fascicle/base/text.hpp"

namespace fascicle {

void throw_error(const std::string& where, const std::string& what, const std::string& expected,
                 ErrorKind kind) {
    std::string message = where.empty() ? what : where + ": " + what;
    if (!expected.empty())
        message += "; expected " + expected;
    throw Error(one_line(message), kind);
}

} // namespace fascicle
