// The kernels for one instruction set; its compiler flags are set in src/solver/CMakeLists.txt.

#include "solver/fast/kernels_coarse.hpp"
#include "solver/fast/lanes_portable.hpp"

namespace fascicle::solver::fast {

const Kernels& kernels_portable() {
    static constexpr Kernels kernels = make_kernels<LanesPortable>("portable");
    return kernels;
}

} // namespace fascicle::solver::fast
