#include "solver/fast/worker_team.hpp"

#if defined(__x86_64__) || defined(__i386__)
#include <immintrin.h>
#endif

namespace fascicle::solver::fast {

namespace {

constexpr int spins_before_yield = 100; // measured: more costs dearly on a busy machine, fewer gains nothing
constexpr int yields_before_sleep = 200;

void pause() {
#if defined(__x86_64__) || defined(__i386__)
    _mm_pause();
#endif
}

} // namespace

WorkerTeam::WorkerTeam(int size) {
    for (int t = 1; t < size; ++t)
        workers_.emplace_back([this, t] { work(t); });
}

WorkerTeam::~WorkerTeam() {
    stop_ = true;
    job_.fetch_add(1, std::memory_order_release);
    job_.notify_all();
    for (std::thread& worker : workers_)
        worker.join();
}

void WorkerTeam::start(void* context, Call call) {
    if (workers_.empty()) {
        call(context, 0);
        return;
    }
    context_ = context;
    call_ = call;
    job_.fetch_add(1, std::memory_order_release);
    job_.notify_all();
    call(context, 0);
    meet();
}

void WorkerTeam::work(int thread) {
    unsigned seen = 0;
    for (;;) {
        unsigned job = job_.load(std::memory_order_acquire);
        for (int n = 0; job == seen; ++n) {
            if (n < spins_before_yield)
                pause();
            else if (n < spins_before_yield + yields_before_sleep)
                std::this_thread::yield();
            else
                job_.wait(seen, std::memory_order_acquire);
            job = job_.load(std::memory_order_acquire);
        }
        seen = job;
        if (stop_)
            return;
        call_(context_, thread);
        meet();
    }
}

void WorkerTeam::meet() {
    if (workers_.empty())
        return;
    const unsigned round = round_.load(std::memory_order_relaxed);
    if (arrived_.fetch_add(1, std::memory_order_acq_rel) == static_cast<int>(workers_.size())) {
        arrived_.store(0, std::memory_order_relaxed);
        round_.store(round + 1, std::memory_order_release);
        return;
    }
    for (int n = 0; round_.load(std::memory_order_acquire) == round; ++n)
        if (n < spins_before_yield)
            pause();
        else
            std::this_thread::yield();
}

} // namespace fascicle::solver::fast
