// The unit of a scene made from mesh files, and their coordinates in it.

#include "fascicle/base/error.hpp"
#include "fascicle/base/param_table.hpp"
#include "fascicle/geometry/axis_mapping.hpp"
#include "fascicle/geometry/bounding_box.hpp"
#include "fascicle/io/mesh_stamp.hpp"
#include "fascicle/io/mesh_units.hpp"
#include "io/load_parts.hpp"

#include <algorithm>

namespace fascicle {
namespace fs = std::filesystem;

void io::settle_units(const std::vector<MeshPtr*>& meshes, const std::vector<MeshSource*>& sources,
                      std::optional<LengthUnit> wanted, LengthUnit& unit, std::vector<std::string>& notes) {
    std::vector<UnitSource> files;
    BoundingBox unstated;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const fs::path path = sources[i]->path;
        const BoundingBox box = bounding_box((*meshes[i])->positions, (*meshes[i])->triangles);
        const MeshStamp stamp = read_mesh_stamp(path);
        files.push_back({path.filename().string(), box.diagonal(), stamp.hints, stamp.up});
        if (const auto said = files[i].hints.millimetres; !said || !stated_unit_fits(*said, box.diagonal()))
            unstated.add(box);
    }
    UnitChoice choice = choose_units(files, unstated.diagonal(), wanted);
    unit = choice.unit;
    notes.insert(notes.end(), choice.notes.begin(), choice.notes.end());
    const std::vector<std::string> frames = frame_notes(files);
    notes.insert(notes.end(), frames.begin(), frames.end());
    for (std::size_t i = 0; i < meshes.size(); ++i)
        if (choice.factors[i] != 1) {
            *meshes[i] =
                std::make_shared<const TriMesh>(mapped(**meshes[i], AxisMapping::as_is, choice.factors[i]));
            sources[i]->hash.clear(); // no longer what the file holds: a project carries it
        }
}

void io::settle_fibre_unit(Muscle& muscle, LengthUnit unit, std::vector<std::string>& notes) {
    const fs::path path = muscle.surface_fibres_source.path;
    const std::string name = path.filename().string();
    const double own = bounding_box(muscle.surface_fibres->points).diagonal(),
                 of_muscle = bounding_box(muscle.mesh->positions).diagonal();
    constexpr double most =
        50; // superficial fibres lie on the muscle, and are about as long: metres and millimetres are a thousand apart
    const auto fits = [&](double size) { return size <= most * of_muscle && of_muscle <= most * size; };
    const std::optional<double> said = read_mesh_hints(path).millimetres;
    const double factor = said ? *said / millimetres_per_unit(unit) : 1.0;
    if (factor != 1 && fits(own * factor)) {
        auto scaled = std::make_shared<Polylines>(*muscle.surface_fibres);
        for (Vec3& p : scaled->points)
            p *= factor;
        muscle.surface_fibres = std::move(scaled);
        muscle.surface_fibres_source.hash.clear(); // no longer what the file holds
        notes.push_back(name + ": says " + unit_words(*said) + ", taken times " + number_text(factor) +
                        " to the scene's " + unit_words(millimetres_per_unit(unit)));
    } else if (own > 0 && of_muscle > 0 && !fits(own)) {
        throw_error(path.string(),
                    "its size (diagonal " + number_text(own) + ") is not that of the muscle " + muscle.name +
                        " (" + number_text(of_muscle) + " " + to_text(unit) + ")",
                    "the unit of the scene: fascicle convert IN OUT --units " + std::string(to_text(unit)));
    }
}

} // namespace fascicle
