#pragma once
// One length unit for the mesh files of a scene: what files state may be converted, with a note; what is guessed never is.

#include "fascicle/io/mesh_hints.hpp"
#include "fascicle/scene/scene.hpp"

namespace fascicle {

/// A mesh file and what is known of its coordinates.
struct UnitSource {
    std::string file;    ///< its name, for messages
    double diagonal = 0; ///< of the box around it, in units of the file
    MeshHints hints;
    std::optional<char> up = {};
};

struct UnitChoice {
    LengthUnit unit = LengthUnit::millimetre;
    std::vector<double> factors; ///< one a file: what its coordinates are multiplied by, 1 for most
    std::vector<std::string> notes;
};

/// `wanted` (--units) is the scene's unit and that of files that state none; else the guess by the diagonal of all of these together; else
/// what files state. A file that states another unit is converted. A unit that makes a mesh smaller than 1 mm or larger than 5 m is not
/// believed, with a note. Error naming two files when sizes tell that those without a unit are in metres and in millimetres: one guessed to
/// be in metres beside one at least 20 times as large in millimetres; with `wanted` this is a note.
UnitChoice choose_units(const std::vector<UnitSource>& files, double unstated_diagonal,
                        std::optional<LengthUnit> wanted);

/// Whether what a file states of its unit fits the size of a bone or muscle: 1 mm to 5 m. True without a size.
bool stated_unit_fits(double millimetres, double diagonal);

/// "1 unit = 1000 mm", and for the usual ones "metres", "millimetres".
std::string unit_words(double millimetres);

/// Notes when files say RAS, or that y is up, in which views have other names, or different frames. Nothing is turned.
std::vector<std::string> frame_notes(const std::vector<UnitSource>& files);

} // namespace fascicle
