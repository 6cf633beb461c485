#pragma once
// Smooth, nearly rigid movements of a surface with few unknowns: overlapping clusters of vertices, each with the six
// rigid modes about its own centre. Vertex i moves by u_i = sum_m w_im (t_m + (omega_m / radius) x (x_i - c_m)).
// The weights of a free vertex sum to one, but fall to zero towards fixed vertices, which have none.

#include "fascicle/base/bytes_of.hpp"
#include "fascicle/geometry/mesh_topology.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <span>

namespace fascicle::solver {

/// Clusters of one vertex; unused places have weight zero.
struct ClusterWeights {
    std::array<std::uint16_t, 4> cluster{};
    std::array<float, 4> weight{};
};

class ClusterBasis {
public:
    ClusterBasis() = default;
    /// Seeds by farthest-point sampling along edges from the fixed vertices, at most `wanted` and one for every 20 free
    /// vertices; weights (1 - d / d5)^2 of the four nearest seeds, d5 the distance of the fifth, times a ramp of
    /// one cluster radius from the fixed vertices. Clusters are numbered so that neighbours are close (reverse
    /// Cuthill-McKee). inverse_mass: V, 0 fixed.
    ClusterBasis(const Points& rest, const MeshTopology& topology, const std::vector<double>& inverse_mass,
                 int wanted);

    int clusters() const { return clusters_; }
    int unknowns() const { return 6 * clusters_; }
    /// Half-width of a matrix that couples the clusters of vertices in one edge or hinge.
    int band() const { return band_; }
    double radius() const { return radius_; }
    const std::vector<ClusterWeights>& weights() const { return weights_; }
    const Vec3& centre(int cluster) const { return centre_[static_cast<std::size_t>(cluster)]; }

    /// Takes x as the shape that frames are measured from: all turns become the identity. x may be reference() itself, filled.
    void set_reference(const Points& x);
    Points& reference() { return reference_; }
    /// Centres and turns of the clusters at x, from the reference. Turns by the iteration of Mueller, Bender, Chentanez,
    /// Macklin 2016, started from the last turn.
    void update_frames(const Points& x);

    /// The same for one cluster from sums that the caller has made: with c any point near its centre, first = sum w (x - c) and
    /// moment = sum w (x - c) (r - d)^T, r the reference and d its centre.
    void set_frame(int cluster, const Vec3& c, const Vec3& first, const Mat3& moment);
    /// Angle (rad) between the turns of two clusters that share a vertex, 2 sin of its half, rms over all such pairs. A
    /// matrix in turned frames is as good as on the day it was made while all clusters turn alike, however far.
    double mean_bend() const;
    Mat3 turn(int cluster) const { return turn_[static_cast<std::size_t>(cluster)].toRotationMatrix(); }

    /// out = Q^T P^T f, 6 values a cluster (force, torque / radius) in the turned frames.
    void restrict_forces(const Points& x, const Points& f, std::span<float> out);
    /// u = P Q q, added to nothing: V displacements.
    void prolong(const Points& x, std::span<const float> q, Points& u);

    std::size_t bytes() const {
        return bytes_of(weights_, reference_, centre_, reference_centre_, turn_, neighbours_, total_, moment_,
                        modes_);
    }

private:
    void find_centres(const Points& x);
    void turn_to(std::size_t cluster, const Mat3& moment);

    int clusters_ = 0, band_ = 0;
    double radius_ = 1;
    std::vector<ClusterWeights> weights_;
    Points reference_, centre_, reference_centre_;
    std::vector<Eigen::Quaterniond> turn_;
    std::vector<std::array<int, 2>> neighbours_; ///< pairs of clusters that share a vertex
    std::vector<double> total_;                  ///< sum of the weights of a cluster
    std::vector<Mat3> moment_;                   ///< scratch, as modes_: nothing is allocated in a frame
    Points modes_;                               ///< two a cluster: force and torque, or shift and turn
};

} // namespace fascicle::solver
