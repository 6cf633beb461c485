#include "view/colouring.hpp"

#include <array>

namespace fascicle::view {

namespace {

constexpr std::array<ColouringRow, 5> colouring_table{{
    {Colouring::anatomy, "anatomy", "Anatomy", "", "Muscle red with attachment areas."},
    {Colouring::strain, "strain", "Edge extension", "Edge extension [1]",
     "Length over rest length of the edges around each vertex."},
    {Colouring::depth, "depth", "Distance to bone", "Distance to bone [mm]",
     "Distance of each vertex to the nearest bone, negative (red) inside one."},
    {Colouring::contact, "contact", "Contact", "",
     "Which vertices are free, touch a bone within 0.2 mm, are deeper inside one, or are attached."},
    {Colouring::fibres, "fibres", "Fibre stretch", "Fibre stretch [1]",
     "Fibres through a translucent muscle, coloured by length over rest length of each segment."},
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
