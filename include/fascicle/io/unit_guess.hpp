#pragma once
// What the size of a mesh says about its length unit, for people: shown wherever meshes come in, acted on only with words.

#include "fascicle/geometry/mesh_check.hpp"
#include "fascicle/scene/scene.hpp"

namespace fascicle {

/// Of the diagonal of the box around everything: below 5 metres, from 5 to 5000 millimetres. Above 5000, and of nothing at all, no unit
/// of a body fits: millimetres or metres all the same, and not sure.
struct UnitGuess {
    LengthUnit unit = LengthUnit::millimetre;
    double diagonal = 0;
    bool sure = false;
    /// "unit guessed: millimetres (diagonal 412); --units tells otherwise"
    std::string sentence() const;
};
UnitGuess guess_length_unit(double diagonal);

/// Whether every part of a surface was inside out before it was mended: the enclosed volume was negative, as of a mesh that a change of
/// axes has mirrored.
bool is_inside_out(const MeshReport& report);
inline constexpr const char* inside_out_words = "it was inside out as a whole: mirrored on the way here, or "
                                                "wound clockwise; a mirrored shape stays mirrored";

} // namespace fascicle
