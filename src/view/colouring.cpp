#include "view/colouring.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::view {

namespace {

using M = ColourMap;

// Signed values, and ratios about 1, go over the diverging map with its grey at the middle; the others over viridis or cividis.
constexpr std::array<ColouringRow, colouring_count> colouring_table{{
    {Colouring::anatomy, "anatomy", "Anatomy", "", "Muscle red with attachment areas.", "", {}, 0, 0},
    {Colouring::strain,
     "strain",
     "Edge extension",
     "Edge extension [1]",
     "Length over rest length of the edges around each vertex.",
     "",
     {M::diverging, 0.75, 1.25, 1.0},
     0,
     4},
    {Colouring::dihedral,
     "dihedral",
     "Dihedral change",
     "Dihedral change [\xC2\xB0]",
     "How much the angles between the triangles around each vertex have changed since rest, on average.",
     "\xC2\xB0",
     {M::viridis, 0, 20},
     0,
     180},
    {Colouring::depth,
     "depth",
     "Penetration",
     "Signed distance [mm]",
     "Close to bones: red inside one, grey at its surface, blue away from it.",
     "mm",
     {M::diverging, -1, 5, 0.0, true},
     -10,
     10},
    {Colouring::distance,
     "distance",
     "Distance to bone",
     "Distance to bone [mm]",
     "Distance of each vertex to the nearest bone; 0 on it and inside.",
     "mm",
     {M::cividis, 0, 30},
     0,
     100},
    {Colouring::contact,
     "contact",
     "Contact",
     "",
     "Which vertices are free, touch a bone within 0.2 mm, are deeper inside one, or are attached.",
     "",
     {},
     0,
     0},
    {Colouring::stiffness,
     "stiffness",
     "Stiffness k",
     "Stiffness k [1]",
     "Stiffness of the edges around each vertex after anisotropy, on average: 0 gives way, 1 is rigid.",
     "",
     {M::viridis, 0, 1},
     0,
     1},
    {Colouring::harmonic,
     "harmonic",
     "Harmonic field",
     "Harmonic field [1]",
     "The smooth field from 0 at the origin to 1 at the insertion, which directions follow where no fibres "
     "are known.",
     "",
     {M::cividis, 0, 1},
     0,
     1},
    {Colouring::fibres,
     "fibres",
     "Fibre stretch",
     "Fibre stretch [1]",
     "Fibres through a translucent muscle, coloured by length over rest length of each segment.",
     "",
     {M::diverging, 0.7, 1.3, 1.0},
     0,
     4},
}};

constexpr std::array<ContactRow, 4> contact_table{{
    {ContactState::free, "Free", {0.56f, 0.59f, 0.63f, 1.0f}},
    {ContactState::touching, "Touching", {0.90f, 0.62f, 0.00f, 1.0f}},
    {ContactState::inside, "Inside bone", {0.72f, 0.05f, 0.35f, 1.0f}},
    {ContactState::attached, "Attached", {0.00f, 0.45f, 0.70f, 1.0f}},
}};

} // namespace

std::span<const ColouringRow> colourings() {
    return colouring_table;
}

const ColouringRow& colouring_row(Colouring colouring) {
    return colouring_table[static_cast<std::size_t>(colouring)];
}

ColourScales::ColourScales() {
    for (const ColouringRow& row : colouring_table)
        (*this)[row.colouring] = row.scale;
}

void set_range(ColourScale& scale, const ColouringRow& row, double low, double high) {
    const double gap = 0.001 * (row.most - row.least);
    if (!std::isfinite(low))
        low = scale.low;
    if (!std::isfinite(high))
        high = scale.high;
    scale.low = std::clamp(low, row.least, (scale.middle ? *scale.middle : row.most) - gap);
    scale.high = std::clamp(high, (scale.middle ? *scale.middle : scale.low) + gap, row.most);
}

ContactState contact_state(double distance_mm, bool attached) {
    if (attached)
        return ContactState::attached;
    if (distance_mm < -touching_mm)
        return ContactState::inside;
    return distance_mm <= touching_mm ? ContactState::touching : ContactState::free;
}

std::span<const ContactRow> contact_rows() {
    return contact_table;
}

} // namespace fascicle::view
