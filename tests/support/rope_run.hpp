#pragma once
// Runs whose fibres are where a formula says: muscles that are straps of four ropes, each vertex of a strap a point of a rope.

#include "fascicle/geometry/primitives.hpp"
#include "fascicle/scene/recording.hpp"
#include "support/shapes.hpp"

#include <functional>

namespace fascicle::test {

/// Place of a point of a rope in a frame, scene units. rope: 0 to 3; level: 0 to levels.
using RopePlace = std::function<Vec3(int rope, int level, int frame)>;

struct RopeMuscle {
    std::string name;
    int levels = 0;
    RopePlace place;
};

/// A scene of bones (boxes of 10 by 12 by 14 at the origin) and a finished recording of all frames of the timeline. Ropes are fixed to bone
/// 0 where they begin and to bone 1 where they end.
inline RecordingPtr rope_run(const std::vector<std::string>& bones, const Timeline& timeline,
                             const std::vector<RopeMuscle>& muscles, bool fibres = true) {
    Scene scene;
    scene.name = "ropes";
    scene.timeline = timeline;
    for (const std::string& name : bones)
        scene.bones.push_back({name, std::make_shared<const TriMesh>(box(10, 12, 14)), {}});
    std::vector<std::vector<Attachment>> attachments;
    std::vector<FibreModelPtr> models;
    std::vector<std::vector<std::pair<int, int>>> rope_of; // of each vertex: rope and level
    for (const RopeMuscle& m : muscles) {
        TriMesh mesh = box_mesh(Vec3(0, 0, 0), Vec3(1, 1, m.levels), {1, 1, m.levels});
        auto& ropes = rope_of.emplace_back();
        std::vector<Attachment> ends{{AttachmentKind::origin, 0, {}}, {AttachmentKind::insertion, 1, {}}};
        auto model = std::make_shared<FibreModel>();
        model->rest = {4, m.levels, Points(static_cast<std::size_t>(4 * (m.levels + 1)))};
        for (int v = 0; v < mesh.vertex_count(); ++v) {
            Vec3& p = mesh.positions[static_cast<std::size_t>(v)];
            const int rope = static_cast<int>(p.x()) + 2 * static_cast<int>(p.y());
            const int level = static_cast<int>(std::lround(p.z()));
            ropes.emplace_back(rope, level);
            p = m.place(rope, level, 0);
            model->rest.points[static_cast<std::size_t>(rope * (m.levels + 1) + level)] = p;
            if (level == 0 || level == m.levels)
                ends[level == 0 ? 0 : 1].vertices.push_back(v);
        }
        const MeshTopology topology(mesh.vertex_count(), mesh.triangles);
        model->carrier = bind_inside(mesh, topology, model->rest.points);
        scene.muscles.push_back({});
        scene.muscles.back().name = m.name;
        scene.muscles.back().mesh = std::make_shared<const TriMesh>(std::move(mesh));
        attachments.push_back(std::move(ends));
        models.push_back(std::move(model));
    }
    auto recording = std::make_shared<Recording>(std::make_shared<const Scene>(std::move(scene)));
    recording->set_attachments(std::move(attachments));
    if (fibres)
        recording->set_fibres(std::move(models));
    for (int k = 0; k <= timeline.last_frame; ++k) {
        auto frame = std::make_shared<Frame>();
        frame->index = k;
        frame->angle_rad = timeline.angle_rad(k);
        for (std::size_t b = 0; b < bones.size(); ++b)
            frame->bone_poses.push_back(timeline.bone_pose(static_cast<int>(b), k));
        for (std::size_t m = 0; m < muscles.size(); ++m) {
            Points points;
            for (const auto& [rope, level] : rope_of[m])
                points.push_back(muscles[m].place(rope, level, k));
            frame->muscle_positions.push_back(std::make_shared<const Points>(std::move(points)));
        }
        recording->append(std::move(frame));
    }
    recording->finish(RunState::finished);
    return recording;
}

/// A rope that comes down in front of a cylinder (radius r about the x axis, the hinge), goes round its underside and leaves to bone 1, which
/// the hinge turns: as CylinderScene. Straight parts of 70 on both sides are rigid with the bones, five points each; `arc` equal
/// pieces lie on the cylinder. Length of the curve 140 + r (pi / 2 + angle), moment arm about the angle -r.
struct WrappedRope {
    int arc = 20;
    static double radius(int rope) { return rope < 2 ? 20.0 : 23.0; }
    int levels() const { return 8 + arc; }
    Vec3 place(int rope, int level, double angle) const {
        const double r = radius(rope), x = rope % 2 == 0 ? -12 : 12, end = 1.5707963267948966 + angle;
        if (level <= 4)
            return {x, -r, 70 * (1 - level / 4.0)};
        const double phi = level <= 4 + arc ? end * (level - 4) / arc : end;
        const double along = level <= 4 + arc ? 0 : 70 * (level - 4 - arc) / 4.0;
        return Vec3(x, -r * std::cos(phi), -r * std::sin(phi)) +
               along * Vec3(0, std::sin(phi), -std::cos(phi));
    }
    /// Of the polygon with `arc` corners on the circle.
    double length(int rope, double angle) const {
        return 140 + 2 * arc * radius(rope) * std::sin((1.5707963267948966 + angle) / (2 * arc));
    }
};

inline Hinge x_hinge() {
    return {Vec3::Zero(), Vec3::UnitX()};
}

} // namespace fascicle::test
