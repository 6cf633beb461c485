#pragma once
// The named scenes of the bench.

#include "fascicle/io/load_scene.hpp"

#include <optional>
#include <string>
#include <vector>

namespace fascicle::bench {

struct BenchCase {
    std::string name;
    SceneRequest request;
    bool published = false; ///< whether the published program was measured on it
    std::string missing;    ///< why it cannot be measured; empty: it can
};

/// gluteus_maximus, iliacus, squish-box, hip; in this order. data: folder that holds lhdl/, or nothing.
std::vector<BenchCase> bench_cases(const std::optional<std::filesystem::path>& data);

/// $FASCICLE_DATA, else ../shared/data seen from the current folder, when that is a folder.
std::optional<std::filesystem::path> default_data_folder();

} // namespace fascicle::bench
