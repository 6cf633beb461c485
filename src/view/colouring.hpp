#pragma once
// What the colours of muscles may show, in one table: the interface and the command line find it here.

#include "view/colour_map.hpp"

#include <span>

namespace fascicle::view {

enum class Colouring { anatomy, strain, depth, contact, fibres };

struct ColouringRow {
    Colouring colouring;
    const char* key;    ///< on the command line
    const char* label;  ///< in the interface
    const char* legend; ///< over the colour bar, with the unit; empty without a bar
    const char* help;   ///< one sentence
};

/// In the order of Colouring.
std::span<const ColouringRow> colourings();
const ColouringRow& colouring_row(Colouring colouring);

/// Where a vertex is, for the eye: `touching` is within touching_mm of a bone, outside or inside, and free to slide;
/// `inside` is deeper than that.
enum class ContactState { free, touching, inside, attached };
inline constexpr double touching_mm = 0.2;

/// distance_mm: signed, negative inside. Attached vertices are that wherever they are.
ContactState contact_state(double distance_mm, bool attached);

struct ContactRow {
    ContactState state;
    const char* label;
    Rgba colour; ///< after Okabe & Ito 2008: told apart with any colour vision, and from the ivory of bones
};
/// In the order of ContactState.
std::span<const ContactRow> contact_rows();

} // namespace fascicle::view
