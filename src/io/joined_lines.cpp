#include "fascicle/io/load_scene.hpp"

#include <algorithm>

namespace fascicle {
namespace {

std::size_t z(int i) {
    return static_cast<std::size_t>(i);
}

/// Appends `piece` to `line`, whose last point is one of the piece's ends; at a shared point it is not repeated.
void append(std::vector<int>& line, const std::vector<int>& piece) {
    if (line.empty())
        line = piece;
    else if (piece.front() == line.back())
        line.insert(line.end(), piece.begin() + 1, piece.end());
    else
        line.insert(line.end(), piece.rbegin() + 1, piece.rend());
}

} // namespace

Polylines joined_lines(const Polylines& pieces) {
    // Lines that end at each point, and how often a point is used at all: only two ends and nothing else are joined.
    std::vector<std::vector<int>> ends(pieces.points.size());
    std::vector<int> uses(pieces.points.size(), 0);
    for (std::size_t i = 0; i < pieces.lines.size(); ++i) {
        const auto& line = pieces.lines[i];
        for (const int p : line)
            ++uses[z(p)];
        if (line.size() >= 2 && line.front() != line.back()) {
            ends[z(line.front())].push_back(static_cast<int>(i));
            ends[z(line.back())].push_back(static_cast<int>(i));
        }
    }
    const auto joins = [&](int p) { return ends[z(p)].size() == 2 && uses[z(p)] == 2; };

    Polylines out;
    out.points = pieces.points;
    std::vector<char> used(pieces.lines.size(), 0);
    const auto walk = [&](int first, bool backwards) {
        std::vector<int> line = pieces.lines[z(first)];
        if (backwards)
            std::reverse(line.begin(), line.end());
        used[z(first)] = 1;
        while (joins(line.back())) {
            const auto& here = ends[z(line.back())];
            const int next = used[z(here[0])] ? here[1] : here[0];
            if (used[z(next)])
                break; // once around a ring
            used[z(next)] = 1;
            append(line, pieces.lines[z(next)]);
        }
        out.lines.push_back(std::move(line));
    };
    for (int i = 0; i < static_cast<int>(pieces.lines.size()); ++i) {
        const auto& line = pieces.lines[z(i)];
        if (used[z(i)] || line.size() < 2)
            continue;
        if (!joins(line.front()) || line.front() == line.back())
            walk(i, false);
        else if (!joins(line.back()))
            walk(i, true);
    }
    for (int i = 0; i < static_cast<int>(pieces.lines.size()); ++i)
        if (!used[z(i)] && pieces.lines[z(i)].size() >= 2)
            walk(i, false); // what is left are rings
    return out;
}

} // namespace fascicle
