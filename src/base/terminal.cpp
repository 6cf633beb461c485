#include "fascicle/base/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

namespace fascicle {

bool stderr_is_terminal() {
    return isatty(STDERR_FILENO) == 1;
}

int terminal_columns() {
    winsize size = {};
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
        return size.ws_col;
    return 80;
}

} // namespace fascicle
