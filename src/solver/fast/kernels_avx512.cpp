// The kernels for one instruction set; its compiler flags are set in src/solver/CMakeLists.txt.

#include "solver/fast/kernels_coarse.hpp"
#include "solver/fast/lanes_avx512.hpp"

namespace fascicle::solver::fast {

const Kernels& kernels_avx512() {
    static constexpr Kernels kernels = make_kernels<LanesAvx512>("avx512");
    return kernels;
}

} // namespace fascicle::solver::fast
