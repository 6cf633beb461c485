#include "fascicle/document/actions/mesh_actions.hpp"

#include "document/actions/hinge_track.hpp"
#include "document/actions/scene_names.hpp"
#include "fascicle/document/actions/import_actions.hpp"
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

void add_meshes(Document& document, const std::vector<NewMesh>& meshes) {
    for (const NewMesh& mesh : meshes) {
        FASCICLE_ASSERT(mesh.mesh != nullptr);
        const MeshReport report = check_mesh(*mesh.mesh);
        if (mesh.role == MeshRole::bone)
            require_bone_surface(report, mesh.path.string());
        else
            require_muscle_surface(report, mesh.path.string());
    }
    if (meshes.empty())
        return;
    Scene& scene = document.edit();
    keep_fibre_templates(scene);
    std::string last;
    for (const NewMesh& mesh : meshes) {
        const bool bone = mesh.role == MeshRole::bone;
        const std::string wanted = mesh.name.empty() ? mesh.path.stem().string() : mesh.name;
        const std::string name = unique_name(scene, wanted, bone ? "bone" : "muscle");
        const MeshSource source{mesh.path.string(), mesh.hash};
        last = (bone ? "bone " : "muscle ") + name;
        if (bone) {
            scene.bones.push_back({name, mesh.mesh, source});
            if (mesh.moving)
                give_hinge_track(scene, scene.bones.size() - 1);
            continue;
        }
        Muscle muscle;
        muscle.name = name;
        muscle.mesh = mesh.mesh;
        muscle.source = source;
        scene.muscles.push_back(std::move(muscle));
    }
    document.commit(meshes.size() == 1 ? "Add " + last : "Add " + std::to_string(meshes.size()) + " meshes");
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
