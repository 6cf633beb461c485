// What a model and a trial hold, before anything is made of them.
#include "fascicle/anatomy/spindle.hpp"
#include "fascicle/io/osim_file.hpp"
#include "fascicle/io/osim_request.hpp"
#include "fascicle/io/storage_file.hpp"
#include "io/osim_scene/osim_bones.hpp"

namespace fascicle {

OsimPreview preview_osim(const std::filesystem::path& model, const std::filesystem::path& trial) {
    OsimPreview preview;
    const OsimModel file = read_osim_file(model);
    const Skeleton& skeleton = file.model.skeleton;
    preview.version = file.version;
    preview.model_name = file.model.name;
    preview.coordinates = skeleton.coordinates.size();
    preview.notes = file.notes;
    for (std::size_t b = 1; b < skeleton.bodies.size(); ++b) {
        OsimPreview::BodyRow row{skeleton.bodies[b].name, 0, {}};
        for (const BodyMesh& mesh : skeleton.bodies[b].meshes)
            if (io::find_model_mesh(model, mesh.file))
                ++row.meshes_found;
            else
                row.missing.push_back(std::filesystem::path(mesh.file).filename().string());
        preview.bodies.push_back(std::move(row));
    }
    for (const LineMuscle& muscle : file.model.muscles) {
        const auto body = [&](const PathPoint& point) {
            return skeleton.bodies[static_cast<std::size_t>(point.body)].name;
        };
        preview.muscles.push_back(
            {muscle.name, body(muscle.points.front()), body(muscle.points.back()),
             1e6 * line_muscle_volume_m3(muscle.max_isometric_force_n, muscle.optimal_fibre_length_m)});
    }
    if (trial.empty())
        return preview;
    const StorageTable table = read_storage_file(trial);
    const CoordinateColumns columns = match_coordinates(table, skeleton);
    preview.rows = table.row_count();
    for (std::size_t c = 0; c < columns.column_of.size(); ++c)
        if (columns.column_of[c] >= 0)
            preview.driven.push_back(skeleton.coordinates[c].name);
    if (const int time = table.column_index("time"); time >= 0) {
        preview.from_s = table.value(0, static_cast<std::size_t>(time));
        preview.to_s = table.value(table.row_count() - 1, static_cast<std::size_t>(time));
    }
    preview.notes.insert(preview.notes.end(), columns.notes.begin(), columns.notes.end());
    return preview;
}

} // namespace fascicle
