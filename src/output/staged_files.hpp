#pragma once
// StagedFiles as the exports call it.

#include "fascicle/io/staged_files.hpp"

namespace fascicle::output {
using fascicle::check_no_input;
using fascicle::StagedFiles;
} // namespace fascicle::output
