#pragma once
// Between which attachments lines run, and how many.

#include "fascicle/base/types.hpp"

#include <vector>

namespace fascicle::solver {

/// The vertices of one part of a surface that are fixed to one solid.
struct AttachedArea {
    int solid = -1;
    std::vector<int> vertices; ///< ascending
    Vec3 middle = Vec3::Zero();
    bool moves = false; ///< whether the solid is known to move
};

/// Indices of areas.
struct AttachmentPair {
    std::size_t from = 0, to = 0;
    int lines = 0;
};

/// Lines run from every area that stays to every one that moves, about `count` in all: to each pair by its shares of the vertices, at
/// least one. Where all move, or none is known to, from the area whose nearest other one is the farthest away (of equals the one with more
/// vertices, then the first) to all others: the insertion of several heads, or the origin of several tendons. Empty for less than
/// two areas.
std::vector<AttachmentPair> pair_attachments(const std::vector<AttachedArea>& areas, int count);

} // namespace fascicle::solver
