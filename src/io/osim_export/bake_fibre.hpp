#pragma once
// One fibre of a run as the path of a muscle.

#include "io/osim_export/baked_motion.hpp"
#include "io/osim_export/spline_fit.hpp"

#include <memory>

namespace fascicle::io {

/// What all fibres share. Places: values of the coordinate in the fitted frames, ascending, K of them.
struct FibreBaking {
    const BakedMotion* motion = nullptr;
    std::vector<double> places;
    std::vector<std::vector<Pose>> poses; ///< K x bodies
    std::vector<SplineFit> fits;          ///< with ever more knots
    double tolerance = 1e-3;              ///< metres
    int other_body = 0; ///< between points of one body: one that moves against it, see bake_fibre
};

FibreBaking fibre_baking(const BakedMotion& motion, double tolerance);

/// The simulated fibre in the fitted frames: K x N points in ground (metres), lengths, and moment arms as fibres.csv has them (none:
/// the coordinate is time).
struct FibreCourse {
    std::size_t points = 0;
    Points places; ///< frame-major
    std::vector<double> lengths, arms;
    std::vector<double> all_lengths;           ///< of every frame of the recording
    int origin_body = -1, insertion_body = -1; ///< that the ends are attached to; -1: not known
    const Vec3& at(std::size_t k, std::size_t j) const { return places[k * points + j]; }
};

/// Points and knots of the fibre. simulated[i]: the index of path point i in the course, -1 for one that was put in half-way between
/// its neighbours. See export_osim for the rules.
struct FibrePath {
    std::vector<double> knots;
    std::vector<BakedPoint> points;
    std::vector<int> simulated;
};
FibrePath bake_fibre(const FibreBaking& baking, const FibreCourse& course);

} // namespace fascicle::io
