#include "simulation/bone_overlap.hpp"

#include "fascicle/geometry/bounding_box.hpp"
#include "fascicle/geometry/winding_number.hpp"
#include "simulation/vertex_clusters.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

namespace fascicle {

namespace {

constexpr int most_samples = 150;
constexpr int most_frames = 1200; ///< frames that are compared with each other
constexpr int cluster_size = 32;

struct RelativePose {
    int frame = 0;
    Pose pose; ///< from the rest frame of the vertices' bone to that of the other
};

/// Frames in which two bones stand to each other as in no earlier one, thinned to most_samples.
std::vector<RelativePose> relative_poses(const Timeline& timeline, int from, int to, double reach) {
    std::vector<RelativePose> found;
    const int stride = (timeline.last_frame + most_frames - 1) / most_frames;
    const double small = 1e-6 * reach;
    for (int frame = 0; frame <= timeline.last_frame; frame += std::max(1, stride)) {
        const Pose pose = timeline.bone_pose(to, frame).inverse().after(timeline.bone_pose(from, frame));
        const bool known = std::any_of(found.begin(), found.end(), [&](const RelativePose& earlier) {
            return (earlier.pose.translation - pose.translation).cwiseAbs().maxCoeff() < small &&
                   (earlier.pose.rotation - pose.rotation).cwiseAbs().maxCoeff() < 1e-6;
        });
        if (!known)
            found.push_back({frame, pose});
    }
    if (found.size() <= most_samples)
        return found;
    std::vector<RelativePose> thinned;
    for (std::size_t s = 0; s < most_samples; ++s)
        thinned.push_back(found[s * (found.size() - 1) / (most_samples - 1)]);
    return thinned;
}

/// One bone, asked about points in its rest frame. The winding number is made when it is first needed.
class Solid {
public:
    explicit Solid(const OverlapBone& bone)
        : bone_(&bone), box_(bounding_box(bone.mesh->positions, bone.mesh->triangles)) {}

    const BoundingBox& box() const { return box_; }
    /// False: certainly outside.
    bool may_be_inside(const Vec3& p) const {
        return (p.array() >= box_.min.array()).all() && (p.array() <= box_.max.array()).all() &&
               (bone_->grid == nullptr || bone_->grid->value(p) <= 0.0);
    }
    bool inside(const Vec3& p) {
        if (!winding_)
            winding_ = std::make_unique<WindingNumber>(*bone_->mesh);
        return winding_->inside(p);
    }
    /// Distance to the surface; anything up to good_enough when it is no more than that.
    double distance(const Vec3& p, int& hint, double good_enough) const {
        return std::sqrt(bone_->tree->closest_squared_distance(p, 1e150, hint, good_enough));
    }

private:
    const OverlapBone* bone_;
    BoundingBox box_;
    std::unique_ptr<WindingNumber> winding_;
};

/// What is known of a cluster or a vertex: where it was asked about, seen from the other bone, and how far around that
/// point nothing changes sides.
struct Known {
    Vec3 at = Vec3::Zero();
    double clear = -1; ///< negative: nothing known
    int hint = -1;
    bool outside(const Vec3& now, double radius) const {
        return clear > radius && (now - at).squaredNorm() < (clear - radius) * (clear - radius);
    }
};

/// Deepest vertex of one bone in another over the poses; `best.depth` is what has to be exceeded.
class Sweep {
public:
    Sweep(const VertexClusters& vertices, Solid& other)
        : vertices_(vertices), other_(other), clusters_(vertices.clusters.size()),
          points_(vertices.points.size()) {}

    void look(const RelativePose& sample, BoneOverlap& best, Vec3& place, bool& found) {
        int hint = -1;
        for (std::size_t c = 0; c < clusters_.size(); ++c) {
            const VertexCluster& cluster = vertices_.clusters[c];
            const Vec3 centre = sample.pose.apply(cluster.centre);
            Known& known = clusters_[c];
            if (known.outside(centre, cluster.radius))
                continue;
            if (known.hint < 0)
                known.hint = hint;
            const double distance = other_.distance(centre, known.hint, 0.0);
            hint = known.hint;
            // A ball that the surface does not reach lies where its centre lies.
            const bool apart =
                distance > cluster.radius && !(other_.may_be_inside(centre) && other_.inside(centre));
            known = {centre, apart ? distance : -1.0, hint};
            if (!apart)
                for (int i = cluster.begin; i < cluster.end; ++i)
                    look_at_vertex(static_cast<std::size_t>(i), sample, hint, best, place, found);
        }
    }

private:
    void look_at_vertex(std::size_t i, const RelativePose& sample, int hint, BoneOverlap& best, Vec3& place,
                        bool& found) {
        const Vec3 p = sample.pose.apply(vertices_.points[i]);
        Known& known = points_[i];
        if (known.outside(p, 0.0) || !other_.may_be_inside(p))
            return;
        if (known.hint < 0)
            known.hint = hint;
        const double distance = other_.distance(p, known.hint, best.depth);
        if (distance <= best.depth) // no deeper, wherever it is
            return;
        if (!other_.inside(p)) {
            known = {p, distance, known.hint};
            return;
        }
        if (!found)
            best.first_frame = sample.frame;
        found = true;
        best.depth = distance;
        best.frame = sample.frame;
        place = p;
    }

    const VertexClusters& vertices_;
    Solid& other_;
    std::vector<Known> clusters_, points_;
};

} // namespace

std::vector<BoneOverlap> find_bone_overlaps(std::span<const OverlapBone> bones, const Timeline& timeline,
                                            double least_depth, const JobControl& control) {
    std::vector<Solid> solids;
    std::vector<VertexClusters> vertices;
    double reach = 0;
    for (const OverlapBone& bone : bones) {
        solids.emplace_back(bone);
        vertices.push_back(cluster_vertices(*bone.mesh, cluster_size));
        reach = std::max(reach, solids.back().box().diagonal());
    }
    std::vector<BoneOverlap> overlaps;
    for (std::size_t a = 0; a < bones.size(); ++a)
        for (std::size_t b = a + 1; b < bones.size(); ++b) {
            if (control.cancelled())
                throw Cancelled();
            const int ia = static_cast<int>(a), ib = static_cast<int>(b);
            BoneOverlap best{ia, ib, least_depth, 0, 0, Vec3::Zero()};
            Sweep of_a(vertices[a], solids[b]), of_b(vertices[b], solids[a]);
            bool found = false;
            for (const RelativePose& sample : relative_poses(timeline, ia, ib, reach)) {
                double before = best.depth;
                Vec3 place;
                of_a.look(sample, best, place, found);
                if (best.depth > before)
                    best.place = timeline.bone_pose(ib, sample.frame).apply(place);
                before = best.depth;
                of_b.look({sample.frame, sample.pose.inverse()}, best, place, found);
                if (best.depth > before)
                    best.place = timeline.bone_pose(ia, sample.frame).apply(place);
            }
            if (found)
                overlaps.push_back(best);
        }
    return overlaps;
}

std::string overlap_note(const Scene& scene, const BoneOverlap& overlap) {
    const auto name = [&](int bone) { return scene.bones[static_cast<std::size_t>(bone)].name; };
    char depth[32];
    std::snprintf(depth, sizeof depth, "%.2f mm", overlap.depth * millimetres_per_unit(scene.unit));
    const std::string first =
        overlap.first_frame == 0 ? "rest" : "frame " + std::to_string(overlap.first_frame);
    const std::string when = overlap.frame == 0 ? std::string(" at rest")
                                                : " at frame " + std::to_string(overlap.frame) +
                                                      " (largest), from " + first + " on";
    return name(overlap.a) + " and " + name(overlap.b) + " overlap by " + depth + when +
           ": where bones overlap no muscle can lie outside of both";
}

} // namespace fascicle
