#include "fascicle/base/parallel.hpp"

#include "fascicle/base/assert.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <memory>
#include <mutex>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <thread>
#include <vector>

namespace fascicle {

namespace {

#ifdef __SANITIZE_THREAD__

/// For ThreadSanitizer builds: Debian's TBB is not instrumented, so the sanitizer cannot see how its tasks follow each other and reports
/// them all. Plain threads let it judge the bodies.
void run_on_threads(int threads, std::size_t chunks, const std::function<void(std::size_t)>& run) {
    std::atomic<std::size_t> next{0};
    std::mutex mutex;
    std::exception_ptr failure;
    const auto work = [&] {
        for (std::size_t c = next++; c < chunks; c = next++)
            try {
                run(c);
            } catch (...) {
                const std::lock_guard lock(mutex);
                if (!failure)
                    failure = std::current_exception();
                next = chunks;
            }
    };
    std::vector<std::thread> workers;
    for (int t = 1; t < threads; ++t)
        workers.emplace_back(work);
    work();
    for (std::thread& worker : workers)
        worker.join();
    if (failure)
        std::rethrow_exception(failure);
}

#else

/// TBB allows as many threads as the machine has, and warns on standard error when more are asked for.
void allow_threads(int threads) {
    static std::mutex mutex;
    static int allowed = hardware_threads();
    static std::unique_ptr<tbb::global_control> control;
    const std::lock_guard lock(mutex);
    if (threads <= allowed)
        return;
    allowed = threads;
    control = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                    static_cast<std::size_t>(threads));
}

#endif

} // namespace

void parallel_for(int threads, std::size_t n, std::size_t chunk,
                  const std::function<void(std::size_t begin, std::size_t end)>& body) {
    FASCICLE_ASSERT(chunk > 0);
    const std::size_t chunks = (n + chunk - 1) / chunk;
    const auto run = [&](std::size_t c) { body(c * chunk, std::min(n, (c + 1) * chunk)); };
    if (threads <= 1 || chunks <= 1) {
        for (std::size_t c = 0; c < chunks; ++c)
            run(c);
        return;
    }
#ifdef __SANITIZE_THREAD__
    run_on_threads(threads, chunks, run);
#else
    allow_threads(threads);
    tbb::task_arena arena(threads);
    arena.execute([&] { tbb::parallel_for(std::size_t{0}, chunks, run); });
#endif
}

int hardware_threads() {
    return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

} // namespace fascicle
