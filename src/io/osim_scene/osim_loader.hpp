#pragma once
// How a scene is made of a model, a trial and meshes; one object a scene.

#include "fascicle/geometry/solid_query.hpp"
#include "fascicle/io/storage_file.hpp"
#include "io/osim_scene/osim_frame.hpp"
#include "io/osim_scene/osim_scene.hpp"

namespace fascicle::io {

struct BoneEntry {
    Bone bone; ///< of a file: as in it; of the model: body's frame, metres
    int body = 0;
    bool of_model = false;
};

struct MuscleEntry {
    Muscle muscle; ///< as in its file; without a mesh for a stand-in
    std::vector<int> bodies;
    int line = -1; ///< of a stand-in: the line muscle
};

class OsimSceneLoader {
public:
    OsimSceneLoader(const SceneRequest& request, const JobControl& control)
        : r_(request), control_(control), where_(request.osim.model.string()) {}

    LoadedScene load();

private:
    const Skeleton& skeleton() const { return model_->skeleton; }
    const std::string& body_name(int b) const { return skeleton().bodies[static_cast<std::size_t>(b)].name; }
    void say(const std::string& note) { loaded_.notes.push_back(note); }
    void read_model();
    int coordinate_named(const std::string& name) const;
    void read_motion();
    int body_named(const std::string& option, const std::string& name) const;
    void read_bones();
    void find_bones();
    bool has_bone(int body) const;
    void require_bone(const std::string& muscle, int body) const;
    void read_muscles();
    std::vector<std::string> muscle_names() const;
    void stand_in(MuscleEntry& entry, const std::string& name) const;
    /// Of the files: the scene's unit is theirs, so that their numbers stay. Without files: metres, the model's.
    void choose_unit();
    /// Body, ground or scan: as asked for, else the one in which muscles and bones fit best.
    void choose_frame();
    void say_posture();
    /// pose of a mesh in metres; mesh in scene units (of files) or metres (of the model). The same mesh when nothing changes.
    MeshPtr placed(const MeshPtr& mesh, const Pose& pose, double scale) const;
    void place_bones();
    void place_muscles();
    /// The path in the model's posture at rest, in the scene.
    Points rest_path(int line) const;
    void make_stand_in(MuscleEntry& entry, const std::vector<std::shared_ptr<const SolidQuery>>& solids);
    int bone_index(int body) const;
    void make_motion();

    const SceneRequest& r_;
    const JobControl& control_;
    std::string where_;
    LoadedScene loaded_;
    Scene& scene_ = loaded_.scene;
    std::shared_ptr<const LineModel> model_;
    std::optional<StorageTable> table_;
    ModelMotion motion_;
    FramePlacement placement_;
    std::vector<BoneEntry> bones_;
    std::vector<MuscleEntry> muscles_;
    double units_ = 1;
};

/// StateHash of bytes.
std::string hash_of(const std::string& bytes);
/// With so many decimals.
std::string fixed(double value, int decimals);

} // namespace fascicle::io
