// Which kernels this processor can run.

#include "solver/fast/layout.hpp"

namespace fascicle::solver::fast {

std::size_t available_kernels(const Kernels** list, std::size_t capacity) {
    std::size_t count = 0;
    const auto add = [&](const Kernels& kernels) {
        if (count < capacity)
            list[count++] = &kernels;
    };
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
        add(kernels_avx512());
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        add(kernels_avx2());
#endif
    add(kernels_portable());
    return count;
}

} // namespace fascicle::solver::fast
