#pragma once
// What a user says about an OpenSim model that a scene is made of.

#include "fascicle/geometry/axis_mapping.hpp"
#include "fascicle/scene/model_motion.hpp"

#include <filesystem>

namespace fascicle {

/// Options beside --osim MODEL --motion TRIAL. SceneRequest::muscles and bones then are texts "MESH=BODY[,BODY...]".
///
/// Bones: with --bone those alone, each of one body; else the meshes that the model names, found beside it, one bone a body,
/// called like it.
/// Muscles: MESH is a file; its first body has the origin, the others insertions. Where there is no file MESH, and a line muscle
/// of the model is called so, a spindle about that one's path stands in (anatomy/spindle.hpp); its bodies are then those of the path's
/// ends, unless BODY,BODY says which of its bodies hold it.
struct OsimRequest {
    std::filesystem::path model;
    /// Absent: of body, ground, scan the one in which muscles and bones meet best (neither gap nor overlap), shown in the notes.
    std::optional<MeshFrame> mesh_frame;
    AxisMapping axes = AxisMapping::as_is; ///< of the model's ground into the scene: never guessed
    std::string coordinate;                ///< that `angle_deg` is; empty: main_coordinate()
    TrialReading reading;
};

MeshFrame parse_mesh_frame(const std::string& text);     ///< Error (usage)
AxisMapping parse_axis_mapping(const std::string& text); ///< Error (usage)
const char* axis_mapping_key(AxisMapping mapping);

/// "MESH=BODY,BODY" cut at the last '='; without one all is MESH.
struct MeshOfBodies {
    std::filesystem::path mesh;
    std::vector<std::string> bodies;
};
MeshOfBodies parse_mesh_of_bodies(const std::string& option, const std::string& text);

/// For the editor and for `info`: what a model and a trial hold. Error as the readers.
struct OsimPreview {
    int version = 0;
    std::string model_name;
    struct BodyRow {
        std::string name;
        int meshes_found = 0;
        std::vector<std::string> missing;
    };
    std::vector<BodyRow> bodies; ///< without ground
    struct MuscleRow {
        std::string name, origin, insertion; ///< bodies of the path's ends
        double volume_cm3 = 0;               ///< of a stand-in; 0: the model does not tell
    };
    std::vector<MuscleRow> muscles;
    std::size_t coordinates = 0;
    std::size_t rows = 0; ///< of the trial; 0: none given
    double from_s = 0, to_s = 0;
    std::vector<std::string> driven; ///< coordinates that the trial has
    std::vector<std::string> notes;
};
OsimPreview preview_osim(const std::filesystem::path& model, const std::filesystem::path& trial);

} // namespace fascicle
