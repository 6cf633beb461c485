#include "fascicle/io/unit_guess.hpp"

#include <cstdio>

namespace fascicle {

std::string UnitGuess::sentence() const {
    char number[40];
    std::snprintf(number, sizeof number, diagonal < 5 ? "%.3g" : "%.0f", diagonal);
    return std::string("unit guessed: ") + (unit == LengthUnit::metre ? "metres" : "millimetres") +
           " (diagonal " + number + (sure ? ")" : ", which fits neither metres nor millimetres)") +
           "; --units tells otherwise";
}

UnitGuess guess_length_unit(double diagonal) {
    UnitGuess guess;
    guess.unit = diagonal < 5 ? LengthUnit::metre : LengthUnit::millimetre;
    guess.diagonal = diagonal;
    guess.sure = diagonal > 0 && diagonal <= 5000;
    return guess;
}

bool is_inside_out(const MeshReport& report) {
    return report.inverted_components > 0 && report.inverted_components >= report.components;
}

} // namespace fascicle
