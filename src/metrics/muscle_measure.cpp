#include "fascicle/metrics/muscle_measure.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/geometry/volume.hpp"
#include "fascicle/metrics/surface_samples.hpp"

#include <cmath>
#include <limits>

namespace fascicle {

namespace {

PointsPtr positions(const Scene& scene, int muscle, const Frame& frame) {
    const auto m = static_cast<std::size_t>(muscle);
    FASCICLE_ASSERT(m < scene.muscles.size() && frame.muscle_positions.size() == scene.muscles.size());
    const PointsPtr points = frame.muscle_positions[m];
    FASCICLE_ASSERT(points != nullptr && points->size() == scene.muscles[m].mesh->positions.size());
    return points;
}

Points centroids_of(const Points& points, const std::vector<Tri>& triangles) {
    Points result;
    face_centroids(points, triangles, result);
    return result;
}

Points midpoints_of(const Points& points, const std::vector<Edge>& edges) {
    Points result;
    edge_midpoints(points, edges, result);
    return result;
}

} // namespace

std::vector<std::shared_ptr<const SolidQuery>> bone_solids(const Scene& scene) {
    std::vector<std::shared_ptr<const SolidQuery>> solids;
    for (const Bone& bone : scene.bones)
        solids.push_back(std::make_shared<const SolidQuery>(*bone.mesh));
    return solids;
}

MuscleMeasure::MuscleMeasure(const Scene& scene, int muscle, const Frame& rest,
                             std::vector<std::shared_ptr<const SolidQuery>> bones,
                             std::optional<std::vector<Attachment>> attachments, int threads,
                             FibreModelPtr fibres)
    : muscle_(muscle), mesh_(scene.muscles.at(static_cast<std::size_t>(muscle)).mesh),
      millimetres_per_unit_(fascicle::millimetres_per_unit(scene.unit)),
      rest_(positions(scene, muscle, rest)), rest_poses_(rest.bone_poses),
      attachments_(std::move(attachments)), rest_volume_(signed_volume(*rest_, mesh_->triangles)),
      topology_(mesh_->vertex_count(), mesh_->triangles), edge_measure_(topology_.edges(), *rest_),
      dihedral_measure_(topology_.dihedrals(), *rest_), rest_distance_measure_(mesh_->triangles, *rest_),
      penetration_measure_(bones, millimetres_per_unit_, *rest_, rest_poses_, threads),
      centroid_measure_(bones, millimetres_per_unit_, centroids_of(*rest_, mesh_->triangles), rest_poses_,
                        threads),
      midpoint_measure_(bones, millimetres_per_unit_, midpoints_of(*rest_, topology_.edges()), rest_poses_,
                        threads) {
    if (fibres != nullptr)
        fibres_ = std::make_unique<FibreMeasure>(scene, muscle, std::move(fibres), rest);
    measure(rest);
}

void MuscleMeasure::measure(const Frame& frame, double overlap_mm) {
    points_ = frame.muscle_positions.at(static_cast<std::size_t>(muscle_));
    FASCICLE_ASSERT(points_ != nullptr && points_->size() == rest_->size());
    report_ = frame.report;
    volume_ = signed_volume(*points_, mesh_->triangles);
    area_ = surface_area(*points_, mesh_->triangles);
    edges_ = edge_measure_.measure(*points_);
    dihedrals_ = dihedral_measure_.measure(*points_);
    rest_distance_ = rest_distance_measure_.measure(*points_);
    penetration_ = penetration_measure_.measure(*points_, frame.bone_poses);
    face_centroids(*points_, mesh_->triangles, samples_);
    centroid_penetration_ = centroid_measure_.measure(samples_, frame.bone_poses);
    edge_midpoints(*points_, topology_.edges(), samples_);
    midpoint_penetration_ = midpoint_measure_.measure(samples_, frame.bone_poses);
    overlap_mm_ = overlap_mm;
    if (fibres_ != nullptr)
        fibres_->measure(frame, volume_);
    drift_mm_ = drift(frame);
}

double MuscleMeasure::volume_cm3() const {
    return volume_ * std::pow(millimetres_per_unit_ / 10.0, 3);
}

double MuscleMeasure::area_cm2() const {
    return area_ * std::pow(millimetres_per_unit_ / 10.0, 2);
}

double MuscleMeasure::drift(const Frame& frame) const {
    if (!attachments_)
        return std::numeric_limits<double>::quiet_NaN();
    double largest = 0.0;
    for (const Attachment& attachment : *attachments_) {
        const auto b = static_cast<std::size_t>(attachment.bone);
        FASCICLE_ASSERT(b < rest_poses_.size() && b < frame.bone_poses.size());
        const Pose motion = frame.bone_poses[b].after(rest_poses_[b].inverse());
        for (const int v : attachment.vertices) {
            const auto i = static_cast<std::size_t>(v);
            largest = std::max(largest, ((*points_)[i] - motion.apply((*rest_)[i])).norm());
        }
    }
    return millimetres_per_unit_ * largest;
}

} // namespace fascicle
