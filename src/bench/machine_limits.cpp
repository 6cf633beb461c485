#include "bench/machine_limits.hpp"

#include <algorithm>
#include <barrier>
#include <chrono>
#include <thread>

namespace fascicle::bench {

namespace {

using Clock = std::chrono::steady_clock;

struct Limit {
    std::string name, unit;
    std::function<double(int threads)> measure;
};

std::string lanes_text(int lanes) {
    return lanes == 1 ? "scalar" : std::to_string(lanes) + " lanes";
}

std::vector<Limit> make_limits(const Machine& machine, double effort) {
    const std::size_t l2 = machine.l2_bytes > 0 ? machine.l2_bytes : std::size_t{1} << 20;
    const std::size_t l3 = machine.l3_bytes > 0 ? machine.l3_bytes : std::size_t{16} << 20;
    const std::size_t largest = std::size_t{512} << 20;
    const auto triad = [effort](std::size_t bytes) {
        return [bytes, effort](int threads) { return triad_gigabytes(threads, bytes, effort); };
    };
    // Half a cache leaves room for everything else; four times the last one leaves it.
    std::vector<Limit> limits{
        {"triad in L2", "GB/s", triad(l2 / 2)},
        {"triad in L3", "GB/s", triad(std::max(l3 / 4, 2 * l2))},
        {"triad in memory", "GB/s", triad(effort < 0.1 ? 2 * l3 : std::min(4 * l3, largest))}};
    for (const int lanes : {16, 8, 1})
        if (can_run_lanes(lanes)) {
            limits.push_back({"multiply-add fp32, " + lanes_text(lanes), "GFlop/s",
                              [=](int threads) { return multiply_add_gigaflops(threads, lanes, effort); }});
            for (const auto& [where, bytes] :
                 {std::pair("L1", std::size_t{16} << 10), std::pair("L2", l2 / 2)})
                limits.push_back({"gather " + std::string(where) + ", " + lanes_text(lanes), "ns/element",
                                  [=, size = bytes](int threads) {
                                      return gather_nanoseconds(threads, lanes, size, effort);
                                  }});
        }
    return limits;
}

} // namespace

double run_together(int threads, const std::function<void(int thread)>& body) {
    Clock::time_point start;
    std::barrier begin(threads, [&start]() noexcept { start = Clock::now(); });
    std::vector<std::thread> others;
    const auto work = [&](int thread) {
        begin.arrive_and_wait();
        body(thread);
    };
    for (int t = 1; t < threads; ++t)
        others.emplace_back(work, t);
    work(0);
    for (std::thread& other : others)
        other.join();
    return std::chrono::duration<double>(Clock::now() - start).count();
}

std::vector<LimitRow> measure_limits(const Machine& machine, const std::vector<int>& threads, int runs,
                                     double effort, const JobControl& control) {
    std::vector<LimitRow> rows;
    const std::vector<Limit> limits = make_limits(machine, effort / runs);
    for (std::size_t k = 0; k < limits.size(); ++k)
        for (const int count : threads) {
            std::vector<double> values;
            for (int r = 0; r < runs; ++r) {
                control.checkpoint("machine limits", double(k) / double(limits.size()));
                values.push_back(limits[k].measure(count));
            }
            rows.push_back({limits[k].name, limits[k].unit, count, spread_of(values)});
        }
    return rows;
}

} // namespace fascicle::bench
