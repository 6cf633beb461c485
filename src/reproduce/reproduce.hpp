#pragma once
// Repeats the experiments of Cervenka & Kohout 2020, with every method of the registry, and measures them.

#include "fascicle/base/job_control.hpp"
#include "reproduce/results.hpp"

namespace fascicle::reproduce {

struct ReproduceOptions {
    std::filesystem::path data;       ///< folder of the public data; empty: none, embedded scenes stand in
    std::filesystem::path out;        ///< runs are kept in its sub-folder `work`
    std::vector<std::string> only;    ///< keys of experiments; empty: all
    std::vector<std::string> methods; ///< of solver_methods(); empty: all
    int threads = 1;                  ///< change no number
    bool is_short = false; ///< few frames, coarse lattices, no parameters' effects: shows that all works
    bool pictures = true;
};

/// The report's parts that are no experiment, for `only`.
inline constexpr const char* sensitivity_key = "sensitivity";
inline constexpr const char* speed_key = "speed";
std::vector<std::string> part_keys();

/// Runs what is not there yet and measures all. control: the stage names what is being done, the share is that of the whole. Throws
/// Cancelled: finished runs stay and are used by the next call. A run that fails is told in its row; errors of input files are thrown.
Results reproduce(const ReproduceOptions& options, const JobControl& control);

} // namespace fascicle::reproduce
