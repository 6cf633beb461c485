#pragma once
// A string pulled tight between two points over bone surfaces: the discrete geodesic, without wrap objects to fit by hand.

#include "fascicle/base/pose.hpp"
#include "fascicle/geometry/segment_query.hpp"
#include "fascicle/geometry/solid_query.hpp"

#include <span>

namespace fascicle {

/// A bone that strings run over. Any unit of length, the same for everything here.
class BoneObstacle {
public:
    /// mesh: usable, triangles outward; kept as a copy of its triangles. Inside is where the generalised winding number says.
    explicit BoneObstacle(const TriMesh& mesh);

    /// Nearest point of the surface, outward direction there (unit), distance to it (negative inside).
    struct Foot {
        double distance = 0;
        Vec3 point = Vec3::Zero();
        Vec3 outward = Vec3::UnitZ();
    };
    Foot foot(const Vec3& x) const;
    double distance(const Vec3& x) const { return solid_.signed_distance(x); }
    /// Whether the segment meets the surface; "no" is certain (SegmentQuery::meets).
    bool meets(const Vec3& a, const Vec3& b) const { return segments_.meets(a, b); }

private:
    SolidQuery solid_;
    SegmentQuery segments_;
    std::vector<Vec3> normals_; ///< per triangle; zero for one without area
};

/// A bone where it is now: `pose` takes the bone's mesh to the frame of the string.
struct PlacedObstacle {
    const BoneObstacle* bone = nullptr;
    Pose pose;
};

struct GeodesicOptions {
    int segments = 40;       ///< between the ends while it is tightened, 2 to 1000
    double clearance = 2e-5; ///< that points of the string keep from the bones, > 0; metres here, so 0.02 mm
};

/// points: the ends, and the bends between them, which rest on bones. touching: the obstacle that a point rests on, or -1; of
/// an end that lies inside of a bone or nearer than the clearance: that bone.
struct GeodesicPath {
    Points points;
    std::vector<int> touching;
    double length = 0;
    /// Whether no part of the string is inside of a bone: its points are outside and nothing of a surface lies between them,
    /// which is tested exactly. Not counted are the ways out, start_depth and end_depth long, from ends that are inside
    /// (attachments often are, by a little).
    bool clear = false;
    double start_depth = 0, end_depth = 0; ///< how far the ends lie under the clearance; 0 when they do not
    int sweeps = 0;
};

/// Shortest string from p to q outside of the obstacles, as far as tightening finds it: a local minimum near the straight
/// line, or near `guess` (a string from before, of any number of points, moved ends allowed; empty: none).
///
/// Every inner point goes to the middle of its neighbours, over-relaxed, and from there, when it is nearer to a bone than the
/// clearance, straight out to it; again and again, on strings of few points first, each halved from the one before. At rest
/// the pull of the two neighbours has no part along the surface: a geodesic in equal steps. Chords over a convex surface or an
/// edge cut in: where one meets a bone its deepest point joins the string, led out, until none does. Then every point goes that
/// the string stays clear without. Length error: of second order in the step, of first order at sharp edges, plus the
/// clearance; too long rather than too short. Deterministic. Error (usage) for bad options, ends that are not finite.
GeodesicPath geodesic_path(const Vec3& p, const Vec3& q, std::span<const PlacedObstacle> obstacles,
                           const GeodesicOptions& options = {}, const Points& guess = {});

} // namespace fascicle
