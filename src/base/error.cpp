#include "fascicle/base/error.hpp"

namespace fascicle {

void throw_error(const std::string& where, const std::string& what, const std::string& expected,
                 ErrorKind kind) {
    std::string message = where.empty() ? what : where + ": " + what;
    if (!expected.empty())
        message += "; expected " + expected;
    for (char& c : message)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
            c = ' ';
    throw Error(message, kind);
}

} // namespace fascicle
