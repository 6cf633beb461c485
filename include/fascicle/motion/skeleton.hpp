#pragma once
// Bodies held together by joints, and where every body is for given values of the joint coordinates.

#include "fascicle/base/pose.hpp"
#include "fascicle/motion/joint_function.hpp"

#include <span>
#include <string>
#include <vector>

namespace fascicle {

/// Rotational coordinates are radians, translational ones metres.
enum class CoordinateKind { rotational, translational };

struct Coordinate {
    std::string name;
    CoordinateKind kind = CoordinateKind::rotational;
    double default_value = 0;
    double range_min = 0, range_max = 0; ///< as the model says; not enforced
    bool locked = false;
    bool clamped = false;
};

/// f(sum_i weight_i q_i). Every function of coordinates that joints use has this form: of one coordinate (weight 1), or
/// linear in several.
struct CoordinateFunction {
    struct Term {
        int coordinate = 0;
        double weight = 1;
    };
    std::vector<Term> terms;
    JointFunction function;

    /// q: values of all coordinates of the skeleton.
    double value(std::span<const double> q) const;
    /// d value / dt for q' = rates.
    double rate(std::span<const double> q, std::span<const double> rates) const;
};

/// A turn (radians) about, or a shift (metres) along, an axis.
struct JointAxis {
    Vec3 axis = Vec3::UnitX(); ///< unit vector
    CoordinateFunction amount;
};

/// Places the child's joint frame M in the parent's joint frame F:
///   R = R(a1, t1) R(a2, t2) R(a3, t3) (each turn about its axis in the frame that the turns before it have made),
///   p = sum of the shifts along their axes in F.
/// Then X_ground_child = X_ground_parent X_parent_F (R, p) X_child_M^-1. Fewer axes for simpler joints.
struct Joint {
    std::string name;
    std::string type;          ///< as the model calls it: CustomJoint, PinJoint, ...
    int parent = 0, child = 0; ///< bodies
    Pose parent_frame;         ///< F in the parent body
    Pose child_frame;          ///< M in the child body
    bool reversed = false;     ///< the axes place F in M instead
    std::vector<JointAxis> rotations;
    std::vector<JointAxis> translations;
};

/// dependent = function of other coordinates.
struct CoordinateCoupler {
    int dependent = 0;
    CoordinateFunction function;
};

/// A mesh that a body is drawn with. Vertices: pose.apply(scale * v) in the body's frame, metres.
struct BodyMesh {
    std::string file;
    Vec3 scale = Vec3::Ones();
    Pose pose;
};

struct Body {
    std::string name;
    double mass_kg = 0;
    Vec3 mass_centre = Vec3::Zero(); ///< body frame, metres
    std::vector<BodyMesh> meshes;
};

/// A plain value. Body 0 is ground. After the lists are filled, arrange_skeleton must be called once.
struct Skeleton {
    std::vector<Body> bodies{Body{"ground", 0, Vec3::Zero(), {}}};
    std::vector<Coordinate> coordinates;
    std::vector<Joint> joints;
    std::vector<CoordinateCoupler> couplers;

    /// Joints from ground outwards; backwards: the child is known and places the parent. Set by arrange_skeleton.
    struct Step {
        int joint = 0;
        bool backwards = false;
    };
    std::vector<Step> order;

    /// Index, or -1.
    int body_index(const std::string& name) const;
    int coordinate_index(const std::string& name) const;
    /// Default of every coordinate, couplers applied.
    std::vector<double> default_values() const;
};

/// Sorts joints from ground outwards and couplers so that each comes after those it depends on. Returns a sentence for
/// each body that no joint ties to ground: it stays in ground's frame. Error (naming `where`): joints that close a loop, a
/// joint from a body to itself, couplers that depend on each other in a circle, two couplers of one coordinate.
std::vector<std::string> arrange_skeleton(Skeleton& skeleton, const std::string& where);

/// Sets the dependent coordinates. q: one value per coordinate.
void apply_couplers(const Skeleton& skeleton, std::span<double> q);

/// Pose of every body in ground. q: one value per coordinate, couplers applied. poses: one per body, resized; no other
/// allocation.
void place_bodies(const Skeleton& skeleton, std::span<const double> q, std::vector<Pose>& poses);

/// Velocity field of a moving body: the body's point that is at x (ground frame) moves with angular x x + linear.
struct Twist {
    Vec3 angular = Vec3::Zero();
    Vec3 linear = Vec3::Zero();
    Vec3 at(const Vec3& x) const { return angular.cross(x) + linear; }
};

/// Rates of all coordinates when `coordinate` goes up by 1 and the others stay, but for those coupled to it. A coordinate
/// that is itself dependent: all but it and what depends on it stay.
void coordinate_rates(const Skeleton& skeleton, std::span<const double> q, int coordinate,
                      std::vector<double>& rates);

/// Twist of every body for the given rates: the exact derivative of place_bodies. poses: of place_bodies at q.
void body_twists(const Skeleton& skeleton, std::span<const double> q, std::span<const double> rates,
                 std::span<const Pose> poses, std::vector<Twist>& twists);

/// Rotation by three angles (radians) about x, then the turned y, then the twice turned z: the orientations of OpenSim's
/// frames.
Mat3 rotation_xyz(const Vec3& angles_rad);

} // namespace fascicle
