#include "fascicle/base/interrupt.hpp"

#include <csignal>

namespace fascicle {

namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "the handler may only touch lock-free flags");

extern "C" void on_interrupt(int number) {
    if (!interrupted.exchange(true))
        return;
    std::signal(number, SIG_DFL);
    std::raise(number);
}

} // namespace

const std::atomic<bool>& watch_interrupts() {
    struct sigaction action = {};
    action.sa_handler = on_interrupt;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART; // reads and writes under way are not to fail with EINTR
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    return interrupted;
}

void report_file_size_limit() {
    std::signal(SIGXFSZ, SIG_IGN);
}

} // namespace fascicle
