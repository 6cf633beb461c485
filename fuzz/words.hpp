#pragma once
// What targets of the command line share.

#include "fuzz/check.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace fascicle::fuzz {

/// A word a line, at most 64; what is beyond is left away.
inline std::vector<std::string> words_of(std::string_view bytes) {
    constexpr std::size_t most_words = 64;
    std::vector<std::string> words;
    while (words.size() < most_words) {
        const std::size_t end = std::min(bytes.find('\n'), bytes.size());
        words.emplace_back(bytes.substr(0, end));
        if (end == bytes.size())
            break;
        bytes.remove_prefix(end + 1);
    }
    return words;
}

/// Calls `parse`, which may refuse its text by an Error of the kind usage, and by nothing else.
template <typename Parse>
void check_usage(const Parse& parse) {
    try {
        parse();
    } catch (const Error& error) {
        check_message(error, {});
        FUZZ_CHECK(error.kind() == ErrorKind::usage);
    }
}

} // namespace fascicle::fuzz
