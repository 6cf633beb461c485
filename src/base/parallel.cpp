#include "fascicle/base/parallel.hpp"

#include "fascicle/base/assert.hpp"

#include <algorithm>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <thread>

namespace fascicle {

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
    tbb::task_arena arena(threads);
    arena.execute([&] { tbb::parallel_for(std::size_t{0}, chunks, run); });
}

int hardware_threads() {
    return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

} // namespace fascicle
