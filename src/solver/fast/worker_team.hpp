#pragma once
// Threads that stay: the whole of a frame runs on all of them, meeting at barriers of a fraction of a microsecond.
// Waiting spins shortly and then yields, so that a busy machine loses little; between frames the threads sleep.

#include <atomic>
#include <thread>
#include <vector>

namespace fascicle::solver::fast {

class WorkerTeam {
public:
    /// size >= 1 threads, the calling one among them.
    explicit WorkerTeam(int size);
    ~WorkerTeam();
    WorkerTeam(const WorkerTeam&) = delete;
    WorkerTeam& operator=(const WorkerTeam&) = delete;

    int size() const { return static_cast<int>(workers_.size()) + 1; }
    /// body(thread), 0 <= thread < size(), on all threads at once; returns when all have ended. body must not throw.
    template <typename Body>
    void run(Body& body) {
        start(&body, [](void* context, int thread) { (*static_cast<Body*>(context))(thread); });
    }
    /// All threads of the team meet; only inside of run().
    void meet();

private:
    using Call = void (*)(void* context, int thread);
    void start(void* context, Call call);
    void work(int thread);

    std::vector<std::thread> workers_;
    void* context_ = nullptr;
    Call call_ = nullptr;
    alignas(64) std::atomic<unsigned> job_{0};
    alignas(64) std::atomic<int> arrived_{0};
    alignas(64) std::atomic<unsigned> round_{0};
    std::atomic<bool> stop_{false};
};

} // namespace fascicle::solver::fast
