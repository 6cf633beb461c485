#pragma once
// All quantities of one frame of one muscle. What belongs to the rest pose is computed once.

#include "fascicle/metrics/dihedral_change.hpp"
#include "fascicle/metrics/edge_extension.hpp"
#include "fascicle/metrics/fibre_measure.hpp"
#include "fascicle/metrics/penetration.hpp"
#include "fascicle/metrics/rest_distance.hpp"
#include "fascicle/scene/recording.hpp"

namespace fascicle {

/// The solids of a scene's bones, in their rest frames: shared by the measures of all muscles.
std::vector<std::shared_ptr<const SolidQuery>> bone_solids(const Scene& scene);

class MuscleMeasure {
public:
    /// rest: frame 0 of the recording. attachments: those in force for this muscle (Recording::attachments),
    /// or nothing when they are not known: then attachment_drift_mm() is NaN.
    MuscleMeasure(const Scene& scene, int muscle, const Frame& rest,
                  std::vector<std::shared_ptr<const SolidQuery>> bones,
                  std::optional<std::vector<Attachment>> attachments, int threads = 1,
                  FibreModelPtr fibres = nullptr);

    /// Measures a frame; everything below is then about that frame. overlap_mm: what MuscleOverlapMeasure, which
    /// looks at all muscles together, says of this one.
    void measure(const Frame& frame, double overlap_mm = 0);

    double millimetres_per_unit() const { return millimetres_per_unit_; }
    const FrameReport& report() const { return report_; }
    double volume_ratio() const { return volume_ / rest_volume_; } ///< V / V0, NaN when V0 = 0
    double volume_cm3() const;
    double area_cm2() const;
    const EdgeExtension& edges() const { return edges_; }
    const DihedralChange& dihedrals() const { return dihedrals_; }
    const Penetration& penetration() const { return penetration_; } ///< of the vertices
    /// The same of the triangles' centroids and of the edges' middles: a bone can come through between vertices.
    const Penetration& centroid_penetration() const { return centroid_penetration_; }
    const Penetration& midpoint_penetration() const { return midpoint_penetration_; }
    /// Null when the muscle has no fibres.
    const FibreMeasure* fibres() const { return fibres_.get(); }
    double overlap_mm() const { return overlap_mm_; } ///< depth in other muscles beyond that at rest
    const RestDistance& rest_distance() const { return rest_distance_; } ///< scene units
    /// Largest distance of an attached vertex from where its bone would carry it rigidly from frame 0. Must
    /// be 0 up to rounding.
    double attachment_drift_mm() const { return drift_mm_; }

    /// For colouring, V values each, of the frame last measured: mean extension of the edges at a vertex, and
    /// depth inside a bone.
    std::vector<double> edge_extension_at_vertices() const { return edge_measure_.at_vertices(*points_); }
    const std::vector<double>& depth_mm_at_vertices() const { return penetration_measure_.depths_mm(); }

private:
    double drift(const Frame& frame) const;

    int muscle_;
    MeshPtr mesh_;
    double millimetres_per_unit_;
    PointsPtr rest_;
    std::vector<Pose> rest_poses_;
    std::optional<std::vector<Attachment>> attachments_;
    double rest_volume_;
    MeshTopology topology_;
    EdgeExtensionMeasure edge_measure_;
    DihedralChangeMeasure dihedral_measure_;
    RestDistanceMeasure rest_distance_measure_;
    PenetrationMeasure penetration_measure_, centroid_measure_, midpoint_measure_;

    std::unique_ptr<FibreMeasure> fibres_;
    PointsPtr points_;
    FrameReport report_;
    Points samples_; ///< kept between calls
    double volume_ = 0, area_ = 0, drift_mm_ = 0, overlap_mm_ = 0;
    EdgeExtension edges_;
    DihedralChange dihedrals_;
    Penetration penetration_, centroid_penetration_, midpoint_penetration_;
    RestDistance rest_distance_;
};

} // namespace fascicle
