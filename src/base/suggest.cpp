#include "fascicle/base/suggest.hpp"

#include <algorithm>

namespace fascicle {

namespace {

/// Three rows of the table, kept from name to name of a long list.
struct Rows {
    std::vector<std::size_t> before2, before, row;
};

/// The distance, or some number from `most` on when it is no less than that.
std::size_t edit_distance_below(std::string_view a, std::string_view b, std::size_t most, Rows& rows) {
    // Optimal string alignment: before[j] is the distance of a's first i-1 letters to b's first j.
    auto& [before2, before, row] = rows;
    for (std::vector<std::size_t>* r : {&before2, &before, &row})
        r->resize(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j)
        before[j] = j;
    std::size_t least_before = 0;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        std::size_t least = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = before[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({before[j] + 1, row[j - 1] + 1, replaced});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before2[j - 2] + 1);
            least = std::min(least, row[j]);
        }
        if (std::min(least, least_before + 1) >= most) // all that follows comes from this row or skips it
            return most;
        least_before = least;
        before2.swap(before);
        before.swap(row);
    }
    return before[b.size()];
}

} // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
    Rows rows;
    return edit_distance_below(a, b, a.size() + b.size() + 1, rows);
}

std::string nearest_name(std::string_view word, const std::vector<std::string>& known) {
    const std::size_t longest = 200; // a mistyped name is short; keeps the table small for any input
    if (word.empty() || word.size() > longest)
        return {};
    std::size_t best = std::max<std::size_t>(2, word.size() / 3) + 1;
    std::string name;
    Rows rows;
    for (const std::string& candidate : known) {
        // Three letters or more that begin a name count as near, however long the name is.
        const bool begins = word.size() >= 3 && candidate.starts_with(word);
        const std::size_t longer = std::max(word.size(), candidate.size()),
                          shorter = std::min(word.size(), candidate.size());
        if (!begins && longer - shorter >= best) // no distance is less than that of the lengths
            continue;
        std::size_t distance = edit_distance_below(word, candidate, best, rows);
        if (begins)
            distance = std::min<std::size_t>(distance, 1);
        if (distance < best && distance < candidate.size()) {
            best = distance;
            name = candidate;
        }
    }
    return name;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& known) {
    const std::string name = nearest_name(word, known);
    return name.empty() ? std::string() : "; did you mean '" + name + "'?";
}

} // namespace fascicle
