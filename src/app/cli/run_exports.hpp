#pragma once
// Exports at a terminal: of a run that is in memory, into files.

#include "app/cli/progress.hpp"
#include "output/export_kinds.hpp"

#include <CLI/CLI.hpp>

namespace fascicle::app {

/// What several kinds have an option for.
struct ExportOptions {
    int morph_targets = 64;
    std::string up; ///< "y", "z"; empty: z for a run, what a file says of itself
};
void add_export_options(CLI::App& app, ExportOptions& options);

/// What `simulate --export KEY,KEY` asks for.
struct Exports {
    bool vtp = false; ///< surfaces of the frames, written while they are solved
    bool png = false; ///< four pictures
    std::vector<const output::ExportKindRow*> kinds;
};
/// Error (usage) naming the known keys, and for what this machine or program cannot write.
Exports read_exports(const std::vector<std::string>& lists);
/// The keys that simulate offers, with commas.
std::string export_keys();

/// All kinds into a run's folder, every `every`-th frame and the last. SIGINT and SIGTERM end it with an Error; the export under way leaves
/// nothing then. Returns what there is to say about them.
std::vector<std::string> write_exports(const Exports& exports, const ExportOptions& options,
                                       const RecordingPtr& recording, const std::filesystem::path& folder,
                                       int every, int threads, ProgressDisplay& progress);

/// One export, drawn or not. As above.
std::vector<std::string> write_export(output::ExportRequest request, const RecordingPtr& recording,
                                      ProgressDisplay& progress);

} // namespace fascicle::app
