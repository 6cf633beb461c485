#pragma once
// Real data that is never committed: $FASCICLE_DATA, else ../shared/data beside the repository.

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace fascicle::test {

inline std::optional<std::filesystem::path> data_dir() {
    if (const char* set = std::getenv("FASCICLE_DATA"); set != nullptr && std::filesystem::is_directory(set))
        return std::filesystem::path(set);
    const std::filesystem::path beside = std::filesystem::path(FASCICLE_SOURCE_DIR) / "../shared/data";
    if (std::filesystem::is_directory(beside))
        return std::filesystem::canonical(beside);
    return std::nullopt;
}

} // namespace fascicle::test

/// First line of a test that needs real data: ends the test as "skipped" in CTest when there is none.
#define FASCICLE_NEED_DATA(dir)                                                                              \
    const auto maybe_data_dir = fascicle::test::data_dir();                                                  \
    if (!maybe_data_dir) {                                                                                   \
        WARN("fascicle-skip: no ../shared/data and FASCICLE_DATA is not set");                               \
        return;                                                                                              \
    }                                                                                                        \
    const std::filesystem::path dir = *maybe_data_dir
