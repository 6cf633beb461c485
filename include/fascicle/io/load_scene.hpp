#pragma once
// A scene from what the user names: an embedded scene, a project file, or mesh files with a motion. The one way in for
// command line and editor.

#include "fascicle/base/job_control.hpp"
#include "fascicle/io/osim_request.hpp"
#include "fascicle/scene/scene.hpp"

#include <filesystem>
#include <optional>
#include <utility>

namespace fascicle {

/// A hinge as the user gives it; without a centre the joint centre is fitted to the moving bones.
struct HingeRequest {
    std::optional<Vec3> centre;
    Vec3 axis = Vec3::UnitX();
};

/// SOURCE of the commands. Exactly one of: `embedded`, `project`, an OpenSim model, or meshes. Beside a model `muscles` and `bones` are
/// MESH=BODY[,BODY...] (osim_request.hpp).
struct SceneRequest {
    std::string embedded;          ///< --scene NAME
    std::filesystem::path project; ///< --project FILE
    std::vector<std::filesystem::path> muscles, bones, moving_bones;
    std::optional<HingeRequest> hinge;
    std::optional<double> angle_deg;
    std::optional<Phases> phases;
    std::filesystem::path
        motion; ///< --motion: keyed poses (.csv) instead of a hinge, of any source; or a model's trial (.mot, .sto)
    OsimRequest osim; ///< --osim MODEL and what goes with it
    std::vector<std::pair<std::string, std::filesystem::path>> attachments;    ///< muscle name, CSV
    std::vector<std::pair<std::string, std::filesystem::path>> surface_fibres; ///< muscle name, polylines
    std::vector<std::pair<std::string, std::filesystem::path>>
        fibre_templates;         ///< muscle name, JSON; of any source
    std::filesystem::path lines; ///< --lines MODEL.osim: line muscles beside the others, of any source
    std::optional<LengthUnit> unit;
    int threads = 1; ///< for reading and for making embedded scenes; changes nothing in the result
};

struct LoadedScene {
    Scene scene;
    std::vector<std::string> notes; ///< what was mended, guessed and assumed, a sentence each
};

/// Reads, mends and checks every file; names are file names without extension. The unit is guessed when not given
/// (diagonal of everything below 5: metres). Moving bones turn about the hinge by the angle, over the phases; with a motion
/// file exactly those bones move that it moves.
/// Error (usage) when the request contradicts itself: several sources or none, two things of one name, a hinge motion
/// without moving bones or beside a motion file, attachments for a muscle that is not there. Error (failed) for every bad file.
LoadedScene load_scene(const SceneRequest& request, const JobControl& control = {});

/// "cx,cy,cz;ax,ay,az", a point and a direction; ";ax,ay,az" leaves the centre to be fitted. Error (usage).
HingeRequest parse_hinge(const std::string& text);
/// "OUT,BACK,REST", three frame counts. Error (usage).
Phases parse_phases(const std::string& text);
/// "mm" or "m". Error (usage).
LengthUnit parse_unit(const std::string& text);
/// "NAME=FILE". Error (usage) naming the option.
std::pair<std::string, std::filesystem::path> parse_named_file(const std::string& option,
                                                               const std::string& text);

/// Single things into a scene that is there already, for the editor. What the file lacks is an Error, what was done to it
/// is added to notes.
Bone load_bone(const std::filesystem::path& path, std::vector<std::string>& notes);
Muscle load_muscle(const std::filesystem::path& path, std::vector<std::string>& notes);
/// Replaces the muscle's outlines by those of a CSV file.
void load_attachments(Muscle& muscle, const std::filesystem::path& path, LengthUnit unit);
/// Replaces the muscle's surface fibres; segments that share points are joined to polylines.
void load_surface_fibres(Muscle& muscle, const std::filesystem::path& path, std::vector<std::string>& notes);
/// Replaces the muscle's own fibre template.
void load_fibre_template(Muscle& muscle, const std::filesystem::path& path);
/// Replaces the scene's timeline by that of a motion file (motion_file.hpp).
void load_motion(Scene& scene, const std::filesystem::path& path, std::vector<std::string>& notes);

/// Puts the line muscles of an OpenSim model into the scene (place_line_muscles), in place of those that it has.
void load_line_muscles(Scene& scene, const std::filesystem::path& path, std::vector<std::string>& notes);

/// Of the box around all meshes (unit_guess.hpp).
double scene_diagonal(const Scene& scene);

/// Polylines from pieces: where exactly two lines end at a point, they become one. Lines keep the order in which they
/// begin; rings stay closed, cut where their first piece begins. Points and their order do not change.
Polylines joined_lines(const Polylines& pieces);

} // namespace fascicle
