#pragma once
// "Did you mean ...?" for mistyped names.

#include <string>
#include <string_view>
#include <vector>

namespace fascicle {

/// Fewest insertions, deletions, replacements and swaps of neighbouring letters that turn a into b.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The known name with the smallest edit distance (the first of several), or a known name that `word` begins;
/// empty when nothing is near, that is further than a third of the word's letters (at least 2).
std::string nearest_name(std::string_view word, const std::vector<std::string>& known);

/// "; did you mean 'x'?", or nothing when nothing is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);

} // namespace fascicle
