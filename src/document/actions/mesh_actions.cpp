#include "fascicle/document/actions/mesh_actions.hpp"

#include "fascicle/io/unit_guess.hpp"

#include "document/actions/hinge_track.hpp"
#include "document/actions/scene_names.hpp"
#include "fascicle/document/actions/import_actions.hpp"
#include "fascicle/geometry/bounding_box.hpp"

namespace fascicle::actions {

void add_meshes(Document& document, const std::vector<NewMesh>& meshes) {
    for (const NewMesh& mesh : meshes) {
        FASCICLE_ASSERT(mesh.mesh != nullptr);
        if (mesh.role == MeshRole::bone)
            require_bone_surface(mesh.report, mesh.path.string());
        else
            require_muscle_surface(mesh.report, mesh.path.string());
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
    const UnitGuess guess = guess_length_unit(bounding_box(mesh.positions, mesh.triangles).diagonal());
    return guess.sure ? std::optional(guess.unit) : std::nullopt;
}

} // namespace fascicle::actions
