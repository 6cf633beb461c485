#pragma once
// How a muscle shortens by itself: its fibres take up slack, and it thickens as they do.
// Source: active strain, Nardinocchi & Teresi 2007, "On the active response of soft living tissues", J Elasticity 88:
// the stress-free shape of the tissue is F = s v(x)v + s^(-1/2) (I - v(x)v), of determinant 1, v the fibres' direction.

#include <cmath>

namespace fascicle {

/// Most that fibres shorten by themselves, as a share of their rest length.
inline constexpr double least_active_length = 0.5;

/// |F e| / |e| for an edge e at rest: sqrt(s^2 c + (1 - c) / s). along = c = (u . v)^2 in [0, 1], u the edge's direction; s > 0 the
/// length along the fibres as a share of rest. 1 for s = 1; s along the fibres, s^(-1/2) across.
inline double active_edge_scale(double along, double s) {
    return std::sqrt(s * s * along + (1.0 - along) / s);
}

} // namespace fascicle
