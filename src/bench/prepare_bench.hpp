#pragma once
// How long it takes from files to solvers at rest.

#include "bench/report.hpp"
#include "bench/variants.hpp"
#include "fascicle/base/job_control.hpp"
#include "fascicle/scene/scene.hpp"

#include <functional>

namespace fascicle::bench {

/// Reads (`read`, told the number of threads) and prepares a case `runs` times with each number of threads: with an empty folder for grids on disk ("cold"),
/// and again with what the last cold run left there ("warm"). A method that leaves nothing has one row, "none". The
/// folder is a temporary one. Stages: read, those of prepare_scene, solvers.
/// Throws Cancelled.
std::vector<PrepareRow> measure_prepare(const std::string& name,
                                        const std::function<Scene(int threads)>& read, const Variant& variant,
                                        const std::vector<int>& threads, int runs, const JobControl& control);

} // namespace fascicle::bench
