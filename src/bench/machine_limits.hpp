#pragma once
// What the machine can do at best, for comparison with what the kernels reach.

#include "bench/report.hpp"
#include "fascicle/base/job_control.hpp"

#include <cstdint>
#include <functional>

namespace fascicle::bench {

/// Bandwidth of triad in L2, L3 and memory, peak of fused multiply-adds, gather throughput; each with every number of
/// threads. effort: 1 takes about a second a row, smaller values less. Throws Cancelled.
std::vector<LimitRow> measure_limits(const Machine& machine, const std::vector<int>& threads, int runs,
                                     double effort, const JobControl& control);

/// Runs body(thread) on `threads` threads that begin together; seconds until the last has ended.
double run_together(int threads, const std::function<void(int thread)>& body);

/// Gigabytes a second of a[i] = b[i] + s c[i] on floats, each thread on arrays of its own, three of them `bytes` large
/// together; 12 bytes an element are counted, as STREAM does (McCalpin 1995), no write-allocate traffic.
double triad_gigabytes(int threads, std::size_t bytes, double effort);

/// Kernels by number of float lanes: 16 (AVX-512), 8 (AVX2 and FMA), 1 (any machine).
bool can_run_lanes(int lanes);

/// Gigaflops of independent chains of x = x * a + b, two operations each.
double multiply_add_gigaflops(int threads, int lanes, double effort);

/// Nanoseconds per element and thread of sums over table[index[i]], random indices into `bytes` of floats.
double gather_nanoseconds(int threads, int lanes, std::size_t bytes, double effort);

} // namespace fascicle::bench
