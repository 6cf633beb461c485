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

/// All files that the options name.
std::vector<std::filesystem::path> input_files(const SourceOptions& source, const SolveOptions& solve);

/// For commands that write one file: Error (usage) when `out` is an input, or a table or mesh of the folder `run` (empty: none); Error when
/// no file can have that name. Before anything is computed.
void check_output_file(const std::filesystem::path& out, const std::string& run, const SourceOptions& source,
                       const SolveOptions& solve);

/// Reads the source and applies the solve options. Error (usage) when there is no source at all.
LoadedScene load(const SourceOptions& source, const SolveOptions& solve);

} // namespace fascicle::app
