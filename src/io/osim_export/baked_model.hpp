#pragma once
// What an exported model says, before it is text. Metres, radians, the model's axes.

#include "fascicle/base/pose.hpp"
#include "fascicle/geometry/tri_mesh.hpp"

#include <array>
#include <string>
#include <vector>

namespace fascicle::io {

/// A Constant (one y, no x), or a SimmSpline.
struct BakedFunction {
    std::vector<double> x, y;
};

/// Body 0 is ground; its other fields say nothing.
struct BakedBody {
    std::string name;
    int bone = -1;         ///< of the scene
    std::string mesh_file; ///< in Geometry/, without the folder
    double mass_kg = 0;
    Vec3 mass_centre = Vec3::Zero();
    std::array<double, 6> inertia{}; ///< xx yy zz xy xz yz about the mass centre, kg m2
};

struct BakedCoordinate {
    std::string name, joint;
    double default_value = 0, range_min = 0, range_max = 0;
    bool rotational = true;
    /// "/jointset/femur_joint/femur_angle"
    std::string path() const { return "/jointset/" + joint + "/" + name; }
};

/// Between parent and child bodies, whose frames coincide when all coordinates are 0. Without a coordinate: a weld. Else turns about,
/// and shifts along, the columns of `axes` through `centre`: amounts of the coordinate itself (hinge: the first turn), or
/// functions of it.
struct BakedJoint {
    std::string name;
    int parent = 0, child = 0;
    int coordinate = -1;
    bool hinge = false;
    Vec3 centre = Vec3::Zero();
    Mat3 axes = Mat3::Identity();
    std::array<BakedFunction, 6> functions; ///< three turns, three shifts; not of a hinge
};

struct BakedPoint {
    int body = 0;
    bool moving = false;
    Vec3 location = Vec3::Zero();                ///< fixed
    std::array<std::vector<double>, 3> at_knots; ///< moving: values at the fibre's knots
};

struct BakedFibre {
    std::string name;
    std::vector<double> knots;
    std::vector<BakedPoint> points;
    double max_force_n = 0, optimal_length_m = 0, tendon_length_m = 0;
};

/// Coordinates but the first follow the first (CoordinateCouplerConstraint). Moving points depend on the first.
struct BakedModel {
    std::string name, credits, publications;
    std::vector<BakedBody> bodies;
    std::vector<BakedCoordinate> coordinates;
    std::vector<BakedJoint> joints;
    std::vector<BakedFibre> fibres;
};

/// The model as an .osim file, version 40000.
std::string osim_text(const BakedModel& model);

/// Mass, mass centre and inertia of the solid inside a closed surface (metres); where it is not closed (no positive volume) those of its
/// bounding box.
void set_mass(const TriMesh& mesh, double density_kg_m3, BakedBody& body);

} // namespace fascicle::io
