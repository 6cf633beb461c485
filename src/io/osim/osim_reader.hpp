#pragma once
// The parts of reading a model; each fills its share of OsimModel.

#include "fascicle/io/osim_file.hpp"
#include "io/osim/osim_frames.hpp"

namespace fascicle::io {

/// More bodies, coordinates or wrap objects than this are refused: they are looked up by walking through them.
inline constexpr std::size_t most_named = 10000;

class OsimReader {
public:
    OsimReader(const OsimDocument& document, OsimModel& result)
        : document_(document), result_(result), skeleton_(result.model.skeleton), frames_(document) {}

    void read();

private:
    // osim_bodies.cpp
    void read_bodies(pugi::xml_node model);
    void read_body(pugi::xml_node node, int body, const std::string& path);
    void read_old_meshes(pugi::xml_node node, Body& body);
    void read_meshes(pugi::xml_node node, const Pose& pose, Body& body);
    void collect_frames(pugi::xml_node node, const std::string& scope);
    // osim_joints.cpp
    void read_joints(pugi::xml_node model);
    void read_joint(pugi::xml_node node, int old_child);
    void read_joint_frames(pugi::xml_node node, int old_child, Joint& joint);
    std::vector<int> read_coordinates(pugi::xml_node node);
    void set_axes(pugi::xml_node node, const std::vector<int>& coordinates, Joint& joint);
    void read_spatial_transform(pugi::xml_node node, Joint& joint);
    void set_coordinate_kinds();
    void read_couplers(pugi::xml_node model);
    // osim_functions.cpp
    /// Function that the element holds, of the coordinates given; `axis` elements may leave it out.
    CoordinateFunction read_function(pugi::xml_node holder, const std::vector<int>& coordinates);
    JointFunction read_one(pugi::xml_node node, int depth);
    int coordinate_named(std::string_view reference, pugi::xml_node node) const;
    std::vector<int> coordinates_named(pugi::xml_node names) const;
    // osim_muscles.cpp, osim_wraps.cpp
    void read_muscles(pugi::xml_node model);
    LineMuscle read_muscle(pugi::xml_node node, pugi::xml_node path, pugi::xml_node defaults);
    PathPoint read_point(pugi::xml_node node);
    void read_moving_point(pugi::xml_node node, const Pose& frame, PathPoint& point);
    void read_wrap_objects(pugi::xml_node set, int body);
    void read_path_wraps(pugi::xml_node path, LineMuscle& muscle);

    const OsimDocument& document_;
    OsimModel& result_;
    Skeleton& skeleton_;
    OsimFrames frames_;
    PassedOver passed_over_;
    std::vector<std::pair<int, std::string>> told_kinds_; ///< coordinate, motion_type
};

} // namespace fascicle::io
