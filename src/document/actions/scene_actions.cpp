#include "fascicle/document/actions/scene_actions.hpp"

#include "document/actions/hinge_track.hpp"
#include "document/actions/scene_names.hpp"
#include "fascicle/scene/line_muscles.hpp"
#include "fascicle/scene/model_motion.hpp"

#include <algorithm>

namespace fascicle::actions {

namespace {

template <class T>
T& checked(std::vector<T>& list, int index) {
    FASCICLE_ASSERT(index >= 0 && index < static_cast<int>(list.size()));
    return list[static_cast<std::size_t>(index)];
}

template <class T>
void erase_at(std::vector<T>& list, int index) {
    if (index < static_cast<int>(list.size())) // tracks may be fewer than bones
        list.erase(list.begin() + index);
}

} // namespace

int add_bone(Document& document, Bone bone, bool moving) {
    FASCICLE_ASSERT(bone.mesh != nullptr);
    Scene& scene = document.edit();
    bone.name = unique_name(scene, bone.name, "bone");
    scene.bones.push_back(std::move(bone));
    if (moving)
        give_hinge_track(scene, scene.bones.size() - 1);
    document.commit("Add bone " + document.scene().bones.back().name);
    return static_cast<int>(document.scene().bones.size()) - 1;
}

int add_muscle(Document& document, Muscle muscle) {
    FASCICLE_ASSERT(muscle.mesh != nullptr);
    Scene& scene = document.edit();
    muscle.name = unique_name(scene, muscle.name, "muscle");
    scene.muscles.push_back(std::move(muscle));
    document.commit("Add muscle " + document.scene().muscles.back().name);
    return static_cast<int>(document.scene().muscles.size()) - 1;
}

void remove_bone(Document& document, int bone) {
    Scene& scene = document.edit();
    const std::string name = checked(scene.bones, bone).name;
    erase_at(scene.bones, bone);
    erase_at(scene.timeline.bone_tracks, bone);
    for (Muscle& muscle : scene.muscles) {
        std::erase_if(muscle.attachments, [&](const Attachment& a) { return a.bone == bone; });
        for (Attachment& attachment : muscle.attachments)
            attachment.bone -= attachment.bone > bone ? 1 : 0;
        std::erase_if(muscle.areas, [&](const AttachmentArea& a) { return a.bone == bone; });
        for (AttachmentArea& area : muscle.areas)
            area.bone -= area.bone > bone ? 1 : 0;
    }
    document.commit("Remove bone " + name);
}

void remove_muscle(Document& document, int muscle) {
    Scene& scene = document.edit();
    const std::string name = checked(scene.muscles, muscle).name;
    erase_at(scene.muscles, muscle);
    document.commit("Remove muscle " + name);
}

bool rename_bone(Document& document, int bone, const std::string& name) {
    if (name.empty() || taken(document.scene(), name))
        return false;
    Scene& scene = document.edit();
    std::string& own = checked(scene.bones, bone).name;
    if (scene.line_muscles != nullptr) { // they know their bones by name
        auto lines = std::make_shared<LineMuscles>(*scene.line_muscles);
        std::replace(lines->bone_of_body.begin(), lines->bone_of_body.end(), own, name);
        scene.line_muscles = std::move(lines);
    }
    if (scene.model_motion != nullptr) {
        auto motion = std::make_shared<ModelMotion>(*scene.model_motion);
        std::replace(motion->bone_of_body.begin(), motion->bone_of_body.end(), own, name);
        scene.model_motion = std::move(motion);
    }
    for (Muscle& muscle : scene.muscles)
        std::replace(muscle.attach_to.begin(), muscle.attach_to.end(), own, name);
    own = name;
    return document.commit("Rename bone to " + name);
}

bool rename_muscle(Document& document, int muscle, const std::string& name) {
    if (name.empty() || taken(document.scene(), name))
        return false;
    checked(document.edit().muscles, muscle).name = name;
    return document.commit("Rename muscle to " + name);
}

} // namespace fascicle::actions
