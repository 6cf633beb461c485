#pragma once
// A scene as a plain value: what is simulated, how it moves, with which parameters. Copies are cheap: meshes
// are shared and never change. Rest positions are those of the meshes.

#include "fascicle/anatomy/attachment.hpp"
#include "fascicle/anatomy/attachment_area.hpp"
#include "fascicle/anatomy/fibre_template.hpp"
#include "fascicle/base/param_table.hpp"
#include "fascicle/geometry/tri_mesh.hpp"
#include "fascicle/motion/timeline.hpp"
#include "fascicle/solver/parameters.hpp"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace fascicle {

enum class LengthUnit { millimetre, metre };
/// Millimetres in one scene unit: 1 or 1000.
double millimetres_per_unit(LengthUnit unit);
const char* to_text(LengthUnit unit); ///< "mm" or "m"

/// Where a mesh (or a motion) came from; empty path: made by the program.
struct MeshSource {
    std::string path;
    std::string hash; ///< StateHash of the file's bytes, empty for made meshes
};

struct Bone {
    std::string name;
    MeshPtr mesh;
    MeshSource source;
};

struct Muscle {
    std::string name;
    MeshPtr mesh;
    MeshSource source;
    /// Attachments in force: `attachments` when not empty, else what `areas` hold (when any has a vertex), else made from `outlines`, else by
    /// distance to the bones (when `attach_automatically`), else none: a free body. The first that is there counts alone.
    std::vector<Attachment> attachments;
    std::vector<AttachmentOutline> outlines;
    std::vector<MeshSource> outline_files; ///< the files the outlines came from
    bool attach_automatically = true;
    /// Bones (names) that nearness may attach it to: the first has its origin, the others insertions. Empty: any bone.
    std::vector<std::string> attach_to;
    std::shared_ptr<const Polylines> surface_fibres; ///< superficial fibres, or null
    MeshSource surface_fibres_source;
    std::shared_ptr<const FibreTemplate> fibre_template; ///< the user's own; null: that of fibres.template
    MeshSource fibre_template_source;
    /// Origins and insertions as vertices of bones. They do not overlap on a bone (give_vertices).
    std::vector<AttachmentArea> areas;
};

/// Whether any area of the muscle has a vertex: areas that are not painted yet do not count.
bool has_painted_areas(const Muscle& muscle);

/// A named frame of the timeline.
struct Marker {
    int frame = 0; ///< 0 to last_frame
    std::string name;
    bool operator==(const Marker&) const = default;
};

struct LineMuscles; // scene/line_muscles.hpp
struct ModelMotion; // scene/model_motion.hpp

struct Scene {
    std::string name = "scene";
    std::string embedded_name; ///< name in embedded_scenes(), empty when made from files
    LengthUnit unit = LengthUnit::millimetre;
    std::vector<Bone> bones;
    std::vector<Muscle> muscles;
    /// Templates that fibres.template may name, by their keys; null: parallel alone.
    std::shared_ptr<const std::vector<FibreTemplate>> fibre_templates;
    /// Line-segment muscles of a model, for comparison: not simulated. null: none.
    std::shared_ptr<const LineMuscles> line_muscles;
    Timeline timeline;
    /// The model and trial that the timeline came from, or null. In force only while model_motion_in_force() says so.
    std::shared_ptr<const ModelMotion> model_motion;
    std::vector<Marker> markers; ///< ascending by frame, one a frame
    MeshSource motion_source;    ///< the file that the timeline came from; empty: from none
    ParamSet parameters = default_parameters();

    int bone_index(std::string_view bone_name) const;     ///< -1 when there is none
    int muscle_index(std::string_view muscle_name) const; ///< -1 when there is none
};

using ScenePtr = std::shared_ptr<const Scene>;

/// The end of a muscle that an attachment is: its kind; one of unknown kind is an insertion when its bone moves, else an origin.
AttachmentKind attachment_end(const Scene& scene, const Attachment& attachment);

} // namespace fascicle
