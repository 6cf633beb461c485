#pragma once
// Fibres before they reach their attachments: layers of the net through the muscle's thickness.

#include "rows.hpp"

namespace fascicle::chmd {

/// One fibre from the first row to the last.
struct Strand {
    double depth = 0;       ///< 0 superficial layer, 1 deepest
    int origin_head = 0;    ///< which head it belongs to at its origin end, 0 the leftmost
    int insertion_head = 0; ///< the same at its insertion end
    Points path;            ///< one point per row
};

/// Of the lines of one column, row by row: those longer than 1.5 times the median of the five about them met another part of
/// the muscle than their neighbours do (at a fold, past the end of the muscle) and are cut to it; then tops and bottoms are
/// evened out along the column by two passes of (1, 4, 1) / 6. At least 1 line.
void even_out(std::vector<Thickness>& lines);

/// Exactly `count` strands, well spread: the net is refined across (s) and in depth (v), about as wide as it is deep,
/// until its (n - 1) s + 1 columns of up to v + 1 layers and the 2 (v - 1) side strands are enough, then evenly thinned
/// out along a path that winds through the columns. Layers at t = 1/v, 2/v, ... < 1 lie at the share t max(1, 0.8 Tmax /
/// T) of a column's mean thickness T, so that thin columns get fewer of them, moved by up to +-1/(2v) in depth and
/// towards the next column by hashed numbers; the first and last layer are the surfaces.
std::vector<Strand> make_strands(const FibreProblem& problem, const Rows& rows);

} // namespace fascicle::chmd
