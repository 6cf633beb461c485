#pragma once
// What a target may expect of a reader.

#include "fascicle/base/error.hpp"
#include "fascicle/io/mesh_data.hpp"

#include <string>
#include <string_view>

namespace fascicle::fuzz {

/// Says what does not hold, and aborts.
[[noreturn]] void failed(const char* condition, const char* file, int line, const std::string& more = {});

/// A condition that must hold whatever the input is; stays in every build.
#define FUZZ_CHECK(condition)                                                                                \
    ((condition) ? static_cast<void>(0) : ::fascicle::fuzz::failed(#condition, __FILE__, __LINE__))

/// An error that a user reads: one printable line that names `name` (empty: nothing in particular).
void check_message(const Error& error, std::string_view name);

/// Calls `read`; false when it ended in an Error, whose message is checked. Any other exception is a finding.
template <typename Read>
bool reads(std::string_view name, const Read& read) {
    try {
        read();
        return true;
    } catch (const Error& error) {
        check_message(error, name);
        return false;
    }
}

/// Finite points, indices in range, arrays of the size that they say.
void check_mesh_data(const MeshData& data);

} // namespace fascicle::fuzz
