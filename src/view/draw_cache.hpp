#pragma once
// Arrays for the GPU made from meshes and frames, kept from one picture to the next.

#include "fascicle/geometry/bounding_box.hpp"
#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/metrics/line_tracker.hpp"
#include "fascicle/scene/recording.hpp"
#include "render/draw_list.hpp"
#include "view/area_marks.hpp"
#include "view/attachment_marks.hpp"
#include "view/bone_distance_cache.hpp"
#include "view/colour_map.hpp"
#include "view/rest_fields.hpp"
#include "view/vertex_means.hpp"

namespace fascicle::view {

using FloatPoints = std::shared_ptr<const std::vector<render::Vec3f>>;
using FloatColours = std::shared_ptr<const std::vector<render::Rgba>>;
using IndexTriangles = std::shared_ptr<const std::vector<std::array<std::uint32_t, 3>>>;

struct SurfaceArrays {
    FloatPoints positions, normals;
};

struct BorderLines {
    FloatPoints points; ///< two per segment
    FloatColours colours;
};

/// Owned by whoever draws the same scene again and again (one cache per view). Everything is keyed by the shared
/// arrays it is made from, and the last result of each object is kept: asking again with the same ones computes nothing.
/// Not thread-safe.
class DrawCache {
public:
    IndexTriangles triangles(std::size_t muscle_or_bone, bool bone, const MeshPtr& mesh);
    /// At rest, in the mesh's own coordinates. A block of few triangles has no normals: its faces are drawn flat.
    SurfaceArrays bone_surface(std::size_t bone, const MeshPtr& mesh);
    SurfaceArrays muscle_surface(std::size_t muscle, const MeshPtr& mesh, const PointsPtr& points);
    SurfaceArrays ghost_surface(std::size_t muscle, const MeshPtr& mesh, const PointsPtr& rest);
    /// Muscle red with coloured attachment areas.
    FloatColours attachment_colours(std::size_t muscle, const MeshPtr& mesh,
                                    const std::vector<Attachment>& attachments, const render::Rgba& base);
    /// Extension against rest through the scale.
    FloatColours extension_colours(std::size_t muscle, const MeshPtr& mesh, const PointsPtr& rest,
                                   const PointsPtr& points, const ColourScale& scale);
    /// Signed distance to the nearest bone, mm, through the scale. poses: one per bone of the scene.
    FloatColours depth_colours(const Scene& scene, std::size_t muscle, const PointsPtr& points,
                               const std::vector<Pose>& poses, const ColourScale& scale);
    /// Of another run's muscle: its surface, its edges (two points each), and the distance of each vertex from `points` to its place
    /// there, mm, through the scale.
    SurfaceArrays compared_surface(std::size_t muscle, const MeshPtr& mesh, const PointsPtr& compared);
    FloatPoints compared_edges(std::size_t muscle, const MeshPtr& mesh, const PointsPtr& compared);
    FloatColours difference_colours(std::size_t muscle, const MeshPtr& mesh, const PointsPtr& points,
                                    const PointsPtr& compared, double millimetres_per_unit,
                                    const ColourScale& scale);
    /// The colour of each vertex's ContactState.
    FloatColours contact_colours(const Scene& scene, std::size_t muscle, const PointsPtr& points,
                                 const std::vector<Pose>& poses, const std::vector<Attachment>& attachments);
    /// Mean dihedral change around each vertex, degrees, through the scale.
    FloatColours dihedral_colours(std::size_t muscle, const MeshPtr& mesh, const PointsPtr& rest,
                                  const PointsPtr& points, const ColourScale& scale);
    /// Distance to the nearest bone, mm, 0 inside, through the scale. poses: one per bone of the scene.
    FloatColours distance_colours(const Scene& scene, std::size_t muscle, const PointsPtr& points,
                                  const std::vector<Pose>& poses, const ColourScale& scale);
    /// A field at rest through the scale; null while there is none.
    FloatColours field_colours(RestField field, const RestFields::Source& source, const ColourScale& scale);
    RestFields& rest_fields() { return rest_fields_; }
    const RestFields& rest_fields() const { return rest_fields_; }
    BorderLines attachment_border(std::size_t muscle, const MeshPtr& mesh,
                                  const std::vector<Attachment>& attachments, const PointsPtr& points);

    /// Segments of the fibres where the muscle is at `points`; colours: their stretch against the muscle at `rest` through the
    /// scale, null without one.
    BorderLines fibre_lines(std::size_t muscle, const MeshPtr& mesh, const FibreModelPtr& fibres,
                            const PointsPtr& rest, const PointsPtr& points, const ColourScale* scale);

    /// Segments of the scene's line muscles in a frame, null: at rest. The scene has some.
    FloatPoints line_paths(const ScenePtr& scene, const FramePtr& frame);

    /// Areas of the scene as they are stored.
    const ShownAreas& scene_areas(const ScenePtr& scene);
    /// Colours and borders of the areas on a bone, over the bone's own colour. highlights: null for none.
    const AreaMarks& bone_marks(std::size_t bone, const MeshPtr& mesh, const ShownAreas& areas,
                                const std::shared_ptr<const std::vector<BoneHighlight>>& highlights,
                                const render::Rgba& base);

    /// Box of all meshes of the scene at rest, shown or not.
    BoundingBox rest_bounds(const Scene& scene);

    /// How many arrays were computed so far: stays the same while nothing changes.
    int computed() const { return computed_ + distances_.computed() + rest_fields_.computed(); }

private:
    struct Object { // a bone, a muscle
        MeshPtr mesh;
        IndexTriangles triangles;
        std::optional<BoundingBox> bounds;
        PointsPtr points, ghost_points;
        SurfaceArrays surface, ghost;
        std::shared_ptr<const MeshTopology> topology;
        // colours and borders
        std::vector<Attachment> attachments;
        bool has_attachments = false;
        std::vector<std::optional<AttachmentKind>> kinds;
        std::vector<BorderSegment> segments;
        FloatColours kind_colours, border_colours;
        render::Rgba kind_base{};
        FloatPoints border_points;
        PointsPtr border_for;
        FloatColours extension_colours;
        PointsPtr extension_rest, extension_points;
        ColourScale extension_scale;
        FloatColours depth_colours, contact_colours;
        BoneDistances depth_for, contact_for; ///< that the colours were made from
        ColourScale depth_scale;
        std::shared_ptr<const VertexDihedralChange> dihedral_change;
        PointsPtr dihedral_rest, dihedral_points;
        VertexValues dihedrals, distances;
        BoneDistances distances_for;
        VertexValues value_colours_for; ///< values that value_colours were made from
        ColourScale value_scale;
        FloatColours value_colours;
        FibreModelPtr fibres;
        PointsPtr fibres_rest, fibres_points;
        std::optional<ColourScale> fibres_scale;
        BorderLines fibre_lines;
        // of another run
        PointsPtr compared_points, edges_points, difference_points, difference_compared;
        SurfaceArrays compared;
        FloatPoints compared_edges;
        FloatColours difference_colours;
        ColourScale difference_scale;
    };
    Object& object(std::vector<Object>& list, std::size_t index, const MeshPtr& mesh);
    const MeshTopology& topology(Object& object);
    void set_attachments(Object& object, const std::vector<Attachment>& attachments);
    FloatColours value_colours(Object& object, const VertexValues& values, const ColourScale& scale);
    SurfaceArrays make_surface(const Points& points, const TriMesh& mesh);

    struct BoneMarks {
        std::unique_ptr<AreaMarks> marks;
        ShownAreas areas; ///< that the marks were made from, as the other two
        std::shared_ptr<const std::vector<BoneHighlight>> highlights;
        render::Rgba base{};
    };
    std::vector<BoneMarks> bone_marks_;
    ScenePtr areas_scene_;
    ShownAreas scene_areas_;

    std::vector<Object> bones_, muscles_;
    std::unique_ptr<LineTracker> lines_;
    ScenePtr lines_scene_;
    FramePtr lines_frame_;
    FloatPoints line_paths_;
    BoneDistanceCache distances_;
    RestFields rest_fields_;
    int computed_ = 0;
};

/// The mesh's own positions as a shared array (no copy).
PointsPtr mesh_points(const MeshPtr& mesh);

} // namespace fascicle::view
