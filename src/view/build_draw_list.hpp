#pragma once
// The one function that turns a scene and a frame into what is drawn; viewport, pictures and tests all use it.

#include "view/camera.hpp"
#include "view/colouring.hpp"
#include "view/draw_cache.hpp"
#include "view/section_plane.hpp"

namespace fascicle::view {

/// What is looked at. Null frames: everything at the rest of its mesh.
struct ViewSubject {
    ScenePtr scene;
    FramePtr frame; ///< the frame shown
    FramePtr rest;  ///< frame 0: the reference of strain and the ghost
    /// Attachments in force, one list per muscle; missing lists: those stored in the scene.
    std::vector<std::vector<Attachment>> attachments;
    /// Fibres of the run, one a muscle, null or missing: none.
    std::vector<FibreModelPtr> fibres{};
    /// Areas on bones; null: those stored in the scene.
    ShownAreas areas{};
    /// What a paint tool would change; null: nothing.
    std::shared_ptr<const std::vector<BoneHighlight>> highlights{};
    /// Muscle vertices to mark with dots; null: none.
    struct MarkedVertices {
        int muscle = -1;
        std::vector<int> vertices;
    };
    std::shared_ptr<const MarkedVertices> marked{};
    /// Of another run at the same frame, one a muscle of this scene with as many vertices; null or missing: none.
    std::vector<PointsPtr> compared{};
};
/// A scene before any run.
ViewSubject subject_of(ScenePtr scene);
/// Frame k of a run, the last one when k is beyond it; at rest when there is no frame yet.
ViewSubject subject_of(const Recording& recording, int k);

/// How the muscles of another run are shown: not at all, translucent over these, as their edges over these, or by
/// colouring these by the distance between the same vertices.
enum class Compared { none, ghost, wire, difference };

struct ViewOptions {
    /// By index of the scene's bones and muscles; missing entries are shown.
    std::vector<bool> hidden_bones, hidden_muscles;
    bool attachments =
        true; ///< areas coloured and outlined; with another colouring than anatomy the outlines alone
    Colouring colouring = Colouring::anatomy;
    /// Legend: scales[colouring].colour(value) and legend_ticks(scales[colouring]).
    ColourScales scales;
    bool fibres = true; ///< where the muscle lets them be seen: translucent, or coloured by them
    bool joint_axis = true;
    bool line_muscles = true; ///< of the scene's model, as lines
    bool rest_ghost = false;  ///< muscles at rest, faint, behind those of a later frame
    bool wireframe = false;
    int focus_bone = -1; ///< while it is painted: all else is faded; -1: none
    Compared compared = Compared::none;
    /// Distance to the other run, mm.
    ColourScale difference_scale{ColourMap::viridis, 0.0, 5.0};
    bool occlusion = false; ///< shade from the neighbourhood; costs time
    std::optional<SectionPlane> section;
    float bone_opacity = 1.0f;
    float muscle_opacity = 1.0f;
    int selected_bone = -1, selected_muscle = -1; ///< drawn brighter; -1: none

    /// Whether fibres of a muscle are to be seen through its surface.
    bool fibres_visible() const {
        return fibres && (colouring == Colouring::fibres || muscle_opacity < 1.0f);
    }
    bool bone_visible(std::size_t i) const { return i >= hidden_bones.size() || !hidden_bones[i]; }
    bool muscle_visible(std::size_t i) const { return i >= hidden_muscles.size() || !hidden_muscles[i]; }
    bool operator==(const ViewOptions&) const = default;
};

/// SurfaceItem.id of a bone or muscle of the scene, for finding an item again.
std::uint64_t bone_item_id(std::size_t bone);
std::uint64_t muscle_item_id(std::size_t muscle);

/// Everything visible. The cache belongs to the caller and to this view; a second call with the same subject and
/// options computes nothing anew. A frame that does not fit the scene (other counts) is a mistake of the caller.
render::DrawList build_draw_list(const ViewSubject& subject, const ViewOptions& options,
                                 const render::CameraPose& camera, DrawCache& cache);

/// Vertices of what is visible, at the subject's frame: for Camera::frame(). All vertices when everything is hidden.
Points visible_points(const ViewSubject& subject, const ViewOptions& options = {});
/// Their box: for Camera::set_scene_bounds().
/// Empty for an empty scene.
BoundingBox visible_bounds(const ViewSubject& subject, const ViewOptions& options = {});

/// Box of everything at rest and wherever the timeline takes the bones (sampled at up to 25 frames): clip planes made
/// from it suit the whole motion.
BoundingBox motion_bounds(const Scene& scene);

/// A camera on what is visible, from the front, the left and a little above (yaw 35, pitch 12 degrees), or from
/// `standard` when given.
Camera picture_camera(const ViewSubject& subject, double aspect, const ViewOptions& options = {},
                      std::optional<StandardView> standard = std::nullopt, WorldAxes axes = WorldAxes::lps);

} // namespace fascicle::view
