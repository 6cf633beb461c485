#pragma once
// SOURCE and how it is solved: the options that `simulate` and `render` share.

#include "fascicle/io/load_scene.hpp"

#include <CLI/CLI.hpp>

namespace fascicle::app {

struct SourceOptions {
    SceneRequest request;
    bool given = false; ///< whether any option of SOURCE was there
};

/// Adds --scene, --project, --muscle, ... . `options` must outlive the parsing.
void add_source_options(CLI::App& app, SourceOptions& options);

struct SolveOptions {
    std::string preset;            ///< name or file; empty: none
    std::string method;            ///< empty: the scene's own
    int iterations = 0;            ///< 0: the scene's own
    int threads = 0;               ///< 0: all of the machine
    std::vector<std::string> sets; ///< KEY=VALUE
};

/// Adds --method, --iterations, --threads, --set. `options` must outlive the parsing.
void add_solve_options(CLI::App& app, SolveOptions& options);

int thread_count(const SolveOptions& options);

/// Puts method, iterations and single values into the set, in this order. Error (usage) naming the key.
void apply(const SolveOptions& options, ParamSet& parameters);

/// Reads the source and applies the solve options. Error (usage) when there is no source at all.
LoadedScene load(const SourceOptions& source, const SolveOptions& solve);

} // namespace fascicle::app
