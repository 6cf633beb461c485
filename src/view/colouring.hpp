#pragma once
// What the colours of muscles may show, in one table: the interface and the command line find it here.

#include "view/colour_map.hpp"

#include <array>
#include <span>

namespace fascicle::view {

enum class Colouring { anatomy, strain, dihedral, depth, distance, contact, stiffness, harmonic, fibres };
inline constexpr std::size_t colouring_count = static_cast<std::size_t>(Colouring::fibres) + 1;

struct ColouringRow {
    Colouring colouring;
    const char* key;    ///< on the command line
    const char* label;  ///< in the interface
    const char* legend; ///< over the colour bar, with the unit; empty without a bar
    const char* help;   ///< one sentence
    const char* unit;   ///< of the scale; "" for a ratio
    ColourScale scale;  ///< as long as nobody sets another; meaningless without a bar
    double least, most; ///< what the ends of a scale may be
    bool has_scale() const { return *legend != '\0'; }
};

/// In the order of Colouring.
std::span<const ColouringRow> colourings();
const ColouringRow& colouring_row(Colouring colouring);

/// One scale for every colouring, at first those of the table.
class ColourScales {
public:
    ColourScales();
    ColourScale& operator[](Colouring colouring) { return scales_[static_cast<std::size_t>(colouring)]; }
    const ColourScale& operator[](Colouring colouring) const {
        return scales_[static_cast<std::size_t>(colouring)];
    }
    bool operator==(const ColourScales&) const = default;

private:
    std::array<ColourScale, colouring_count> scales_;
};

/// Sets the ends, within the row's limits and around the scale's middle, with some range left between them. An end that is no number
/// stays as it was.
void set_range(ColourScale& scale, const ColouringRow& row, double low, double high);

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
