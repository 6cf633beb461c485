#pragma once
// Lengths, stretches and directions of fibres, from their points alone.

#include "fascicle/anatomy/fibre_set.hpp"

#include <string>

namespace fascicle {

/// The end of a fibre: its point 0, or its point R.
enum class FibreEnd { origin, insertion };

/// Error naming `where`, the fibre and the point when the set is not what FibreSet promises: count below 0, no
/// segment, as many points as not fit, or a coordinate that is not finite.
void check_fibres(const FibreSet& fibres, const std::string& where);

/// L_f = sum_j |p_(j+1) - p_j|, F values >= 0 in scene units (methods.md 7). Zero for a fibre whose points all
/// coincide. The second form reallocates nothing once `lengths` has held F values.
std::vector<double> fibre_lengths(const FibreSet& fibres);
void fibre_lengths(const FibreSet& fibres, std::vector<double>& lengths);

/// (L - L0) / L0 per fibre (methods.md 7): 0 at rest, negative when shorter, never below -1; NaN where L0 = 0.
/// Equally many lengths, in the same unit.
std::vector<double> fibre_strains(std::span<const double> lengths, std::span<const double> rest_lengths);

/// Length of each segment against its length at rest, F x R, fibre-major (regional stretch, methods.md 7): 1 at
/// rest; NaN where the segment has no length at rest. Both sets of the same shape.
std::vector<double> segment_stretch(const FibreSet& fibres, const FibreSet& rest);

/// The same at points, F x (R + 1): both segments at a point together against both at rest, at the ends the one
/// segment there. For colouring.
std::vector<double> point_stretch(const FibreSet& fibres, const FibreSet& rest);

/// Unit tangent at each point, F x (R + 1), from origin to insertion: that of the parabola through the point and
/// its neighbours, t ~ u_- l_+ + u_+ l_- (u, l: direction and length of the segments before and after), so second
/// order for uneven points and exact on a circle; at the ends the direction of the segment there. Segments without length are passed
/// over; where a fibre turns straight back the segment before decides; zero for a fibre without length.
Points fibre_tangents(const FibreSet& fibres);

} // namespace fascicle
