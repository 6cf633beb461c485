#pragma once
// Tables of a run by what they begin with: a file of the same name may be a user's own.

#include "fascicle/io/files.hpp"

namespace fascicle::io {

/// Removes the file when it begins with `head`, the names of the first columns as we write them; more may follow. No error.
inline void remove_own_table(const std::filesystem::path& path, std::string_view head) {
    if (read_head(path, head.size()) != head)
        return;
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
}

} // namespace fascicle::io
