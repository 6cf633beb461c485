#include "fascicle/document/actions/mesh_actions.hpp"

#include "fascicle/document/actions/scene_actions.hpp"
#include "fascicle/document/actions/timeline_actions.hpp"
#include "fascicle/geometry/bounding_box.hpp"

namespace fascicle::actions {

int add_mesh(Document& document, MeshRole role, const std::filesystem::path& path, const MeshFile& file,
             double scale, bool moving) {
    FASCICLE_ASSERT(scale > 0);
    if (role == MeshRole::bone)
        require_bone_surface(file.report, path.string());
    else
        require_muscle_surface(file.report, path.string());
    auto mesh = std::make_shared<TriMesh>(file.mesh);
    if (scale != 1)
        for (Vec3& p : mesh->positions)
            p *= scale;
    const std::string name = path.stem().string();
    const MeshSource source{path.string(), scale == 1 ? file.hash : std::string()};
    if (role == MeshRole::muscle) {
        Muscle muscle;
        muscle.name = name;
        muscle.mesh = std::move(mesh);
        muscle.source = source;
        return add_muscle(document, std::move(muscle));
    }
    return add_bone(document, {name, std::move(mesh), source}, moving);
}

std::optional<LengthUnit> guess_unit(const TriMesh& mesh) {
    const double diagonal = bounding_box(mesh.positions, mesh.triangles).diagonal();
    if (diagonal > 0 && diagonal < 5)
        return LengthUnit::metre;
    if (diagonal >= 5 && diagonal <= 5000)
        return LengthUnit::millimetre;
    return std::nullopt;
}

} // namespace fascicle::actions
