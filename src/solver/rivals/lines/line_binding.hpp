#pragma once
// A surface that goes with lines: each vertex follows frames on the lines next to it, as in linear blend skinning.

#include "solver/rivals/lines/line_sheaf.hpp"

namespace fascicle::solver {

/// Frames along one line.
inline constexpr std::size_t line_stations = 25;

/// Stations at equal shares of a polyline's length, and unit tangents there (over the neighbours, smoothed), zero where it has no
/// length. Both get line_stations points.
void find_stations(const Points& nodes, Points& places, Points& tangents);

class LineBinding {
public:
    LineBinding(const SoftBodyProblem& problem, const MeshTopology& topology, const EndShares& shares,
                const std::vector<MuscleLine>& lines);
    /// Where the lines and solids take every vertex that they hold; others are left as they are:
    ///   x = X + (1 - f) sum w (R X + t - X) + sum f_s (pose_s X - X).
    /// free: V, 0 where a vertex is left as it is.
    void place(const std::vector<MuscleLine>& lines, std::span<const ContactSolid> solids, int threads,
               const std::vector<double>& free, Points& x);
    std::size_t bytes() const;

private:
    struct Station {
        int index; ///< line * line_stations + place on it
        double weight;
    };
    struct Hold {
        int solid;
        double share;
    };
    void find_frames(const std::vector<MuscleLine>& lines, std::span<const ContactSolid> solids);

    Points rest_;
    std::vector<Points> rest_places_, rest_tangents_; ///< by line
    std::vector<int> starts_{0}, hold_starts_{0};     ///< by vertex
    std::vector<Station> stations_;
    std::vector<Hold> holds_;
    std::vector<Pose> frames_; ///< by station: from rest to now
    Points places_, tangents_;
};

} // namespace fascicle::solver
