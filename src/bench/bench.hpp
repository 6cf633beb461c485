#pragma once
// The whole bench: what to measure, and a report of it.

#include "bench/report.hpp"
#include "fascicle/base/job_control.hpp"

#include <filesystem>

namespace fascicle::bench {

struct BenchOptions {
    std::optional<std::filesystem::path> data; ///< folder with lhdl/
    std::vector<std::string> cases;            ///< names; empty: all
    std::vector<std::string> methods;          ///< names of variants; empty: all
    std::vector<std::string> parts;            ///< of part_names(); empty: all
    std::vector<int> threads{1, 2};            ///< ascending, not empty
    int runs = 5;
    int frames = 0; ///< of one run, at most; 0: the whole motion
    bool is_short =
        false; ///< least effort that still goes through everything: for tests, figures mean nothing
};

/// frames, scaling, prepare, fibres, paint, limits
const std::vector<std::string>& part_names();
/// Names of all cases.
std::vector<std::string> case_names();

/// Measures and fills ratios and warnings. Error when a case cannot be read or prepared; Cancelled.
Report run_bench(const BenchOptions& options, const JobControl& control);

/// The report for people: machine, tables, what was left out, warnings.
std::string report_table(const Report& report);
/// The report for programs, one JSON object; the keys are documented in docs/performance.md.
std::string report_json(const Report& report);

} // namespace fascicle::bench
