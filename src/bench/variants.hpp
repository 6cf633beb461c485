#pragma once
// What is compared: a method with everything that tells it from the others.

#include "fascicle/base/param_table.hpp"

#include <string>
#include <vector>

namespace fascicle::bench {

struct Variant {
    std::string name;   ///< classic, reference, sweeps, fast, bullet
    std::string method; ///< solver.method; empty: not one of ours
    std::string kernel; ///< solver.kernel; empty: the program has no choice of kernels
    int passes = 3;     ///< a frame
    int threads = 1;
    bool coarse = true; ///< false: without the coarse step, whatever the scene says
};

/// Names of all variants, whether this program has them or not.
const std::vector<std::string>& variant_names();

/// classic (3 loops, 1 thread); reference (3 and 10 substeps, 1 thread); fast, and sweeps, which is fast without the coarse
/// step: one sweep a substep and nothing else (3 and 10 substeps, each number of threads), when the table has solver.kernel with that choice; bullet (3 iterations, 1 thread).
std::vector<Variant> make_variants(const ParamTable& table, const std::vector<int>& threads);

/// Whether the table has a row solver.kernel with this choice.
bool has_kernel(const ParamTable& table, const std::string& kernel);

/// Puts method, kernel and passes into a scene's parameters.
void apply(const Variant& variant, ParamSet& parameters);

} // namespace fascicle::bench
