#include "fuzz/target.hpp"

#include "fuzz/check.hpp"
#include "fuzz/memory_guard.hpp"

#include <chrono>
#include <ctime>

namespace fascicle::fuzz {
namespace {

constexpr double most_seconds = 10;

/// Time of the processor, since on a busy machine the clock's says nothing. Asking for it takes longer than many an input:
/// that is done once a second, so that the time of a long input may be one second too long.
class Stopwatch {
public:
    void start() {
        start_ = Clock::now();
        if (start_ - asked_ < std::chrono::seconds(1))
            return;
        asked_ = start_;
        used_ = std::clock();
    }
    /// 0 when it is not long.
    double seconds() const {
        return Clock::now() - start_ < std::chrono::seconds(1)
                   ? 0
                   : double(std::clock() - used_) / CLOCKS_PER_SEC;
    }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_, asked_;
    std::clock_t used_ = 0;
};

Stopwatch& stopwatch() {
    static Stopwatch watch;
    return watch;
}

/// What is made once and kept is not made again, and a container that has grown has room: an input that needs more each time leaks.
/// (libFuzzer's own search, -detect_leaks, has a call for each allocation, and none of it is found without malloc_context_size.)
void check_leaks(const Target& target, std::string_view bytes) {
    constexpr int times = 8;
    std::size_t kept = 0;
    for (int i = 0; i < times; ++i) {
        const std::size_t before = live_memory();
        target.run(bytes);
        if (live_memory() <= before)
            return;
        kept = live_memory() - before;
    }
    failed("all memory is given back", __FILE__, __LINE__, std::to_string(kept) + " bytes more each time");
}

} // namespace

const Target* find_target(std::string_view name) {
    for (const Target& target : targets())
        if (target.name == name)
            return &target;
    return nullptr;
}

std::size_t run_guarded(const Target& target, std::string_view bytes) {
    reset_peak_memory();
    const std::size_t before = live_memory();
    Stopwatch& watch = stopwatch();
    watch.start();
    target.run(bytes);
    if (const double seconds = watch.seconds(); seconds > most_seconds)
        failed("an input takes seconds at most", __FILE__, __LINE__, std::to_string(seconds) + " s");
    const std::size_t most = peak_memory() - before;
    if (const std::size_t allowed = target.memory_base + target.memory_per_byte * bytes.size();
        most > allowed)
        failed("memory stays within a small multiple of the file", __FILE__, __LINE__,
               std::to_string(most) + " bytes, allowed are " + std::to_string(allowed));
    if (live_memory() > before)
        check_leaks(target, bytes);
    return most;
}

} // namespace fascicle::fuzz
