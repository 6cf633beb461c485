#pragma once
// summary.json of a run.

#include "fascicle/io/run_writer.hpp"
#include "io/earlier_exports.hpp"

namespace fascicle::io {

/// Indented JSON text. vtp_frames: the frames that have files. exports: further files of the run, relative to its folder.
std::string run_summary(const Recording& recording, const RunOutputOptions& options,
                        const std::vector<int>& vtp_frames, const std::vector<ExportedFile>& exports = {});

} // namespace fascicle::io
