// The kernels for one instruction set; its compiler flags are set in src/solver/CMakeLists.txt.

#include "solver/fast/kernels_coarse.hpp"
#include "solver/fast/lanes_avx2.hpp"

namespace fascicle::solver::fast {

const Kernels& kernels_avx2() {
    static constexpr Kernels kernels = make_kernels<LanesAvx2>("avx2");
    return kernels;
}

} // namespace fascicle::solver::fast
