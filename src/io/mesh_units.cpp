#include "fascicle/io/mesh_units.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/base/param_table.hpp"
#include "fascicle/io/mesh_stamp.hpp"
#include "fascicle/io/unit_guess.hpp"

#include <algorithm>
#include <cstdio>

namespace fascicle {
namespace {

constexpr double smallest_mm = 1, largest_mm = 5000;
/// No mesh of a body is as small in millimetres, nor as large in metres.
constexpr double smallest_in_mm = 2;
constexpr double least_ratio = 20; ///< in size between a mesh in metres and one in millimetres

std::string rounded(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

/// Those without a unit whose size does not fit that of the largest one, in whatever unit the scene is.
std::vector<const UnitSource*> misfits(const std::vector<const UnitSource*>& unstated,
                                       const UnitSource*& largest) {
    std::vector<const UnitSource*> small;
    for (const UnitSource* file : unstated)
        if (largest == nullptr || file->diagonal > largest->diagonal)
            largest = file;
    for (const UnitSource* file : unstated)
        if (file->diagonal > 0 && file->diagonal < smallest_in_mm && largest->diagonal >= 5 &&
            largest->diagonal >= least_ratio * file->diagonal)
            small.push_back(file);
    return small;
}

void compare_sizes(const std::vector<const UnitSource*>& unstated, bool wanted,
                   std::vector<std::string>& notes) {
    const UnitSource* largest = nullptr;
    for (const UnitSource* small : misfits(unstated, largest)) {
        const std::string what = "seems to be in metres (diagonal " + rounded(small->diagonal) + "), " +
                                 largest->file + " in millimetres (diagonal " + rounded(largest->diagonal) +
                                 ')';
        if (!wanted)
            throw_error(small->file, what,
                        "one unit: fascicle convert IN OUT --units mm, or --units here when all are in one");
        notes.push_back(small->file + ": " + what + "; both are taken as --units says");
    }
}

/// A unit for files that state different ones: millimetres where one has them, metres where all have.
LengthUnit stated_by_all(const std::vector<double>& stated) {
    return std::all_of(stated.begin(), stated.end(), [](double mm) { return mm == 1000; })
               ? LengthUnit::metre
               : LengthUnit::millimetre;
}

} // namespace

bool stated_unit_fits(double millimetres, double diagonal) {
    const double size = millimetres * diagonal;
    return diagonal == 0 || (size >= smallest_mm && size <= largest_mm);
}

std::string unit_words(double millimetres) {
    if (millimetres == 1)
        return "millimetres";
    return millimetres == 1000 ? "metres" : "1 unit = " + number_text(millimetres) + " mm";
}

UnitChoice choose_units(const std::vector<UnitSource>& files, double unstated_diagonal,
                        std::optional<LengthUnit> wanted) {
    UnitChoice choice;
    std::vector<const UnitSource*> unstated;
    std::vector<double> stated(files.size(), 0), all_stated;
    for (std::size_t i = 0; i < files.size(); ++i) {
        const UnitSource& file = files[i];
        if (file.hints.millimetres && stated_unit_fits(*file.hints.millimetres, file.diagonal)) {
            stated[i] = *file.hints.millimetres;
            all_stated.push_back(stated[i]);
            continue;
        }
        if (file.hints.millimetres)
            choice.notes.push_back(file.file + ": says " + unit_words(*file.hints.millimetres) +
                                   ", which its size does not fit (diagonal " + rounded(file.diagonal) +
                                   "); this is passed over");
        unstated.push_back(&file);
    }
    compare_sizes(unstated, wanted.has_value(), choice.notes);
    if (wanted) {
        choice.unit = *wanted;
    } else if (!unstated.empty() || files.empty()) {
        const UnitGuess guess = guess_length_unit(unstated_diagonal);
        choice.unit = guess.unit;
        choice.notes.push_back(guess.sentence());
    } else {
        choice.unit = stated_by_all(all_stated);
        choice.notes.push_back(std::string("unit: ") + unit_words(millimetres_per_unit(choice.unit)) +
                               ", as files say");
    }
    const double scene_mm = millimetres_per_unit(choice.unit);
    for (std::size_t i = 0; i < files.size(); ++i) {
        choice.factors.push_back(stated[i] > 0 ? stated[i] / scene_mm : 1.0);
        if (choice.factors[i] != 1)
            choice.notes.push_back(files[i].file + ": says " + unit_words(stated[i]) + ", taken times " +
                                   number_text(choice.factors[i]) + " to the scene's " +
                                   unit_words(scene_mm));
    }
    return choice;
}

std::vector<std::string> frame_notes(const std::vector<UnitSource>& files) {
    std::string lps, ras;
    for (const UnitSource& file : files)
        if (file.hints.space) {
            std::string& names = *file.hints.space == MeshSpace::ras ? ras : lps;
            names += (names.empty() ? "" : ", ") + file.file;
        }
    std::vector<std::string> notes;
    if (!ras.empty() && !lps.empty())
        notes.push_back("frames differ: RAS in " + ras + ", LPS in " + lps +
                        "; nothing is turned: fascicle convert IN OUT --axes ras_to_lps");
    else if (!ras.empty())
        notes.push_back("the frame is RAS in " + ras +
                        "; nothing is turned, and views are named for LPS: fascicle convert IN OUT --axes "
                        "ras_to_lps");
    std::string y_up, others;
    for (const UnitSource& file : files) {
        std::string& names = file.up == 'y' ? y_up : others;
        names += (names.empty() ? "" : ", ") + file.file;
    }
    if (!y_up.empty())
        notes.push_back("y is up in " + y_up + ", as the file says" +
                        (others.empty() ? "" : ", which " + others + " do not say") +
                        "; nothing is turned: fascicle convert IN OUT --axes y_up_to_lps");
    return notes;
}

} // namespace fascicle
