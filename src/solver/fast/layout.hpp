#pragma once
// How the fast kernel keeps its constraints and vertices: plain arrays in packets of 16, the same for every instruction set.
// Widths follow the measurements in docs/performance.md: positions are records of four floats so that a
// constraint loads its vertices with one aligned load each.

#include <cstddef>
#include <cstdint>

namespace fascicle::solver::fast {

inline constexpr std::size_t packet = 16;       ///< constraints, or vertices, side by side
inline constexpr std::size_t chunk_groups = 16; ///< vertex groups whose sums are added up as one
inline constexpr std::size_t chunk_vertices = packet * chunk_groups;
inline constexpr std::size_t block_dummies = 16; ///< unmovable records behind every block, for padding

/// Sixteen distance constraints with no vertex in common. Indices count from the first record of the set.
struct alignas(64) EdgePacket {
    float rest[packet];
    float gain
        [packet]; ///< 1 / max(wa + wb + alpha~, kappa alpha~), alpha~ = alpha / h^2: the weights are known beforehand
    float stiffness[packet]; ///< of the edge as a spring of the coarse step
    std::uint16_t p[2][packet];
};

/// What an EdgePacket's rest lengths are made from when fibres shorten by themselves.
struct alignas(64) ActivePacket {
    float rest[packet];  ///< of fibres at their rest length
    float along[packet]; ///< (u.v)^2
};

/// Sixteen dihedral constraints with no vertex in common; vertex roles as in Dihedral.
struct alignas(64) HingePacket {
    float cosine[packet], sine[packet]; ///< of the rest angle
    float compliance[packet];           ///< alpha / h^2
    std::uint16_t p[4][packet];
};

/// Sixteen vertices that follow each other in memory, apart from their position records.
struct alignas(64) VertexGroup {
    float start[3][packet]; ///< where the vertex was when the substep began
    float carried[3]
                 [packet]; ///< start plus the share of the solids' motion: what the velocity is measured from
    float gradient[3][packet]; ///< of the volume
    float normal[3][packet];   ///< of the last contact, zero without one; read only when `touched`
    std::uint32_t ring_base;   ///< record that the ring's indices count from
    std::uint32_t ring_first;  ///< row of 16 in the list of ring indices
    std::uint32_t ring_length; ///< rows: the ring's vertices in order, the first one repeated at the end
    std::uint32_t touched;     ///< whether any vertex had a contact in the last substep
    std::uint32_t
        suspects; ///< bit i: vertex i may have come too near to a solid or through it, see clamp_motion()
};

/// Sixteen contact samples of equal weights; see ContactSample. Corners count from `base`; padding repeats the first sample.
struct alignas(64) SamplePacket {
    std::uint16_t p[3][packet];
    float weight[3];
    float limit;             ///< of the solid near_solid: the least of the samples' limits
    std::int32_t near_solid; ///< -1: none has a limit of its own
    std::uint32_t base;
    std::uint16_t first_chunk, last_chunk; ///< of vertices, that the corners lie in
    std::uint32_t count;
};

/// Vertices of one group that are fixed to one solid.
struct alignas(64) FixedGroup {
    float rest[3][packet];
    std::uint32_t group;
    std::uint32_t solid;
    std::uint32_t mask; ///< bit i: vertex i of the group
};

/// Hinges as springs for the coarse step: stiffness share / max(alpha~, thin sum |grad|^2).
struct HingeSprings {
    float share;
    float thin;
};

/// Sixteen vertices of one cluster of the coarse step; padding has weight 0.
struct alignas(64) MemberPacket {
    float weight[packet];
    std::uint16_t index[packet]; ///< records after `base`
    std::uint32_t base;
};

struct CoarseMembers {
    const MemberPacket* packets;
    std::size_t count;
};

/// The clusters of the sixteen vertices of a group, four each; unused ones have weight 0.
struct alignas(64) CoarseShare {
    float weight[4][packet];
    std::uint16_t cluster[4][packet];
};

/// Most clusters that the coarse step can have.
inline constexpr std::size_t max_clusters = 1024;

/// A solid during one substep, in coordinates relative to the kernel's origin. 3 x 4 matrices are row-major, last column
/// the shift.
struct SolidStep {
    const float* values; ///< nodes of the distance grid, x fastest
    int cells[3];        ///< cells along each axis
    int step_y, step_z;  ///< nodes from one row, one layer, to the next
    float to_grid[12];   ///< position -> grid coordinates in spacings, at the end of the substep
    float turn[9];       ///< gradient per spacing in the rest frame -> gradient per length, now
    float carry[12];     ///< displacement of a point that moves with the solid during the substep
    float place[12];     ///< rest position -> position now
    float saturation;
    float per_slope; ///< 1 / Lipschitz constant of the interpolant
    bool moves;      ///< carry is not zero
};

/// What a substep does with every vertex after the constraints.
struct StepSettings {
    float offset; ///< wanted distance to solids
    float least;  ///< hard bound below it
    float friction;
    float keep;         ///< exp(-damping h)
    float volume_gain;  ///< multiplier of the volume gradient, already limited
    float volume_error; ///< its sign says which way vertices in contact must not be pushed
    int solids;
};

/// Sums over a chunk of vertices for the volume constraint.
struct VolumeSums {
    double volume = 0;
    double weight_grow =
        0; ///< sum of w |g|^2 with the part into contacts left out when the volume is too small
    double weight_shrink = 0; ///< the same when it is too large
};

/// Sums over a chunk for the report.
struct ContactSums {
    std::int64_t contacts = 0;
    std::int64_t unresolved = 0;
    std::int64_t non_finite = 0;
    std::int64_t slid = 0, ejected = 0, impossible = 0; ///< by the hard bound
};

/// Arrays of all vertices, by group.
struct VertexArrays {
    float* records = nullptr; ///< x, y, z, inverse mass
    VertexGroup* groups = nullptr;
    float* slack =
        nullptr; ///< solids x 16 per group: how far a vertex may travel before the solid can matter
    const float* carry = nullptr; ///< solids x 16 per group, or null: share of a solid's motion
    const std::uint16_t* rings = nullptr;
};

/// The kernels of one instruction set. begin and end count vertex groups, or packets.
struct Kernels {
    const char* name;
    int lanes;
    void (*edges)(float* records, const EdgePacket* packets, std::size_t count);
    /// relax >= 1: a hinge gives way by at least relax alpha~, however small its gradient.
    void (*hinges)(float* records, const HingePacket* packets, std::size_t count, float relax);
    void (*volume)(const VertexArrays& v, std::size_t begin, std::size_t end, VolumeSums& sums);
    /// travel: by solid, how far any of the vertices has moved at most as the solid sees it.
    void (*finish)(const VertexArrays& v, std::size_t begin, std::size_t end, const SolidStep* solids,
                   const StepSettings& settings, ContactSums& sums, float* travel);
    /// travel: as that of finish, a row of `stride` for each chunk. slack: solids a packet. violations: bits of the samples that are nearer to a solid than they may be. Returns how many
    /// packets have some.
    std::size_t (*samples)(const float* records, const SamplePacket* packets, std::size_t begin,
                           std::size_t end, const SolidStep* solids, const StepSettings& settings,
                           const float* travel, std::size_t stride, float* slack, std::uint16_t* violations);
    void (*predict)(const VertexArrays& v, std::size_t begin, std::size_t end, const SolidStep* solids,
                    const StepSettings& settings);
    void (*place)(const VertexArrays& v, const FixedGroup* fixed, std::size_t count, const SolidStep* solids);
    // The coarse step: kernels_coarse.hpp.
    void (*edge_forces)(const float* records, float* forces, const EdgePacket* packets, std::size_t count);
    void (*hinge_forces)(const float* records, float* forces, const HingePacket* packets, std::size_t count,
                         const HingeSprings& springs);
    double (*edge_stiffness)(const float* records, const float* moves, const EdgePacket* packets,
                             std::size_t count, std::size_t stride);
    double (*hinge_stiffness)(const float* records, const float* moves, const HingePacket* packets,
                              std::size_t count, std::size_t stride, const HingeSprings& springs);
    void (*loads)(const VertexArrays& v, std::size_t begin, std::size_t end, float pressure, float* forces,
                  float* gradients);
    void (*sum_loads)(const float* records, const float* first, const float* second,
                      const CoarseMembers& members, const float centre[3], float out[12]);
    void (*sum_shape)(const float* records, const float* reference, const CoarseMembers& members,
                      const float centres[6], float out[12]);
    double (*spread)(const VertexArrays& v, const CoarseShare* shares, std::size_t begin, std::size_t end,
                     const float* motion, float* moves);
    void (*apply)(float* records, const float* moves, std::size_t begin, std::size_t end, float share);
};

/// Fastest first; only those that this processor can run.
std::size_t available_kernels(const Kernels** list, std::size_t capacity);

const Kernels& kernels_portable();
const Kernels& kernels_avx2();
const Kernels& kernels_avx512();

} // namespace fascicle::solver::fast
