#pragma once
// OpenSim's model files (.osim): skeleton, line muscles, wrap objects.

#include "fascicle/anatomy/line_model.hpp"

#include <filesystem>
#include <string_view>

namespace fascicle {

struct OsimModel {
    LineModel model;
    int version = 0;                ///< of the file format: 30000 is OpenSim 3, 40000 OpenSim 4
    std::vector<std::string> notes; ///< what was passed over or assumed, a sentence each
};

/// Reads files of OpenSim 2 (20300 on), 3 (a joint inside of each body) and 4 (a set of joints, frames with offsets).
///
/// Joints: CustomJoint, PinJoint, SliderJoint, UniversalJoint, BallJoint, GimbalJoint, PlanarJoint, FreeJoint, WeldJoint.
/// Functions: Constant, LinearFunction (of several coordinates, too), PolynomialFunction, SimmSpline, NaturalCubicSpline,
/// PiecewiseLinearFunction, MultiplierFunction. Constraints: CoordinateCouplerConstraint. Points: PathPoint,
/// ConditionalPathPoint, MovingPathPoint. Wrap objects: WrapSphere, WrapCylinder, WrapEllipsoid; a WrapTorus is read, and
/// muscles that name it run past it, with a note. Any other force, constraint or element is passed over, with a note where
/// it could matter for the geometry.
///
/// Error (failed) naming file and line, for XML that is not well-formed, another format, values that are not what their
/// element needs, names of nothing, joints and functions that are not among these: guessing would move bones wrongly. Files
/// above 64 MB or with more than two million tags are refused, and no entity but the five of XML itself is replaced, so that
/// memory stays within a small multiple of the file.
OsimModel read_osim(std::string_view bytes, const std::string& file);
OsimModel read_osim_file(const std::filesystem::path& path);

} // namespace fascicle
