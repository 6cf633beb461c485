#pragma once
// What is fuzzed: one row for each reader.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace fascicle::fuzz {

constexpr std::size_t kB = 1024, MB = 1024 * kB;

struct Target {
    std::string name;
    /// Reads the bytes and checks what came of them; an abort is a finding. Must leave nothing behind: no file, no memory.
    std::function<void(std::string_view bytes)> run;
    std::size_t max_length; ///< bytes that libFuzzer tries at most
    std::string dictionary; ///< fuzz/dict/<this>.dict; empty: none
    std::string seeds;      ///< fuzz/corpus/<this>
    /// Live heap during a run is at most memory_base + memory_per_byte * size; more is a finding.
    std::size_t memory_per_byte;
    std::size_t memory_base;
};

/// All of them; a new row of mesh_formats() is a target by itself.
const std::vector<Target>& targets();
/// Null when there is none of that name.
const Target* find_target(std::string_view name);

/// Runs the target on the bytes and watches its memory; where some is kept it is run again: if that is so each time, it leaks.
/// Returns the largest live heap, bytes, beyond what was there.
std::size_t run_guarded(const Target& target, std::string_view bytes);

} // namespace fascicle::fuzz
