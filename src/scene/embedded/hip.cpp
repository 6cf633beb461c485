#include "embedded.hpp"
#include "hip_shapes.hpp"

#include "fascicle/base/parallel.hpp"
#include "fascicle/geometry/iso_surface.hpp"

#include <utility>

namespace fascicle::embedded {

namespace {

/// A bone's mesh with the samples it was made from, which the muscles are carved with.
struct MadeBone {
    Bone bone;
    std::shared_ptr<const ImplicitField> field;
};

MadeBone make_bone(const char* name, const Implicit& f, const FieldBox& box, int triangles, int threads) {
    MadeBone made;
    made.field = std::make_shared<ImplicitField>(f, box, threads);
    made.bone.name = name;
    made.bone.mesh = std::make_shared<TriMesh>(mesh_implicit(f, *made.field, {triangles, 3, threads}));
    return made;
}

Muscle make_muscle(const char* name, const Implicit& f, const FieldBox& box, int triangles, int threads) {
    const ImplicitField field(f, box, threads);
    Muscle muscle;
    muscle.name = name;
    muscle.mesh = std::make_shared<TriMesh>(mesh_implicit(f, field, {triangles, 4, threads}));
    muscle.attach_automatically = false;
    return muscle;
}

/// The vertices closer than `distance` to the bone that `where` accepts.
template <typename Where>
Attachment attach(AttachmentKind kind, const TriMesh& mesh, int bone, const Implicit& f, double distance,
                  const Where& where) {
    Attachment attachment{kind, bone, {}};
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const Vec3& p = mesh.positions[static_cast<std::size_t>(v)];
        if (where(p) && f(p) < distance)
            attachment.vertices.push_back(v);
    }
    return attachment;
}

} // namespace

/// Millimetres; flexion turns the femur about the centre of its head, the origin, by a negative angle about +x.
Scene make_hip(int threads) {
    // Two jobs at a time: the femur needs nothing, the hip bone needs the sacrum, the muscles need all bones.
    MadeBone sacrum, iliac, femur;
    const auto look_up = [](const MadeBone& made) {
        return [field = made.field](const Vec3& p) { return (*field)(p); };
    };
    parallel_for(threads, 2, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t job = begin; job < end; ++job)
            if (job == 0) {
                femur = make_bone("femur", femur_shape().value, {Vec3(-77, -32, -414), Vec3(32, 63, 31), 2.1},
                                  20000, threads);
            } else {
                const ImplicitShape solid = sacrum_shape();
                sacrum = make_bone("sacrum", solid.value, {Vec3(26, -22, -36), Vec3(154, 102, 134), 2.0},
                                   8000, threads);
                iliac =
                    make_bone("right_iliac", iliac_shape({look_up(sacrum), solid.centre, solid.radius}).value,
                              {Vec3(-60, -78, -84), Vec3(95, 93, 161), 1.9}, 26000, threads);
            }
    });
    const HipBones bones{look_up(iliac), look_up(sacrum), look_up(femur)};

    Scene scene;
    scene.bones = {iliac.bone, sacrum.bone, femur.bone};
    scene.timeline = make_hinge_timeline({Vec3::Zero(), Vec3::UnitX()}, -1.0, {100, 100, 100}, 3, {2});

    Muscle gluteus, iliacus;
    parallel_for(threads, 2, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t job = begin; job < end; ++job)
            if (job == 0)
                gluteus = make_muscle("gluteus_maximus", gluteus_maximus_shape(bones).value,
                                      {Vec3(-90, 5, -155), Vec3(92, 120, 138), 2.4}, 15000, threads);
            else
                iliacus = make_muscle("iliacus", iliacus_shape(bones).value,
                                      {Vec3(-60, -70, -85), Vec3(40, 60, 150), 2.0}, 10000, threads);
    });
    gluteus.attachments = {
        attach(AttachmentKind::origin, *gluteus.mesh, 0, bones.iliac, 1.0,
               [](const Vec3& p) { return p.z() > 40.0; }),
        attach(AttachmentKind::origin, *gluteus.mesh, 1, bones.sacrum, 1.0, [](const Vec3&) { return true; }),
        attach(AttachmentKind::insertion, *gluteus.mesh, 2, bones.femur, 1.0,
               [](const Vec3& p) { return p.z() < -62.0; })};
    iliacus.attachments = {attach(AttachmentKind::origin, *iliacus.mesh, 0, bones.iliac, 1.0,
                                  [](const Vec3& p) { return p.norm() > 57.0; }),
                           attach(AttachmentKind::insertion, *iliacus.mesh, 2, bones.femur, 1.0,
                                  [](const Vec3& p) { return (p - lesser_trochanter).norm() < 16.0; })};
    scene.muscles = {std::move(gluteus), std::move(iliacus)};
    return scene;
}

} // namespace fascicle::embedded
