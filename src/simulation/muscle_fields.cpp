#include "simulation/muscle_fields.hpp"

#include "fascicle/anatomy/harmonic_field.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle {

namespace {

std::vector<double> weights_by_distance(const Muscle& muscle, const std::vector<BoneQuery>& bones) {
    const std::size_t count = bones.size();
    std::vector<double> weights(muscle.mesh->positions.size() * count, 0.0);
    for (std::size_t i = 0; i < muscle.mesh->positions.size(); ++i) {
        double sum = 0;
        for (std::size_t b = 0; b < count; ++b) {
            const double d = bones[b].distance(muscle.mesh->positions[i], 1e300);
            weights[i * count + b] = 1.0 / std::max(d, 1e-12);
            sum += weights[i * count + b];
        }
        for (std::size_t b = 0; b < count; ++b)
            weights[i * count + b] = bones[b].moves ? weights[i * count + b] / sum : 0.0;
    }
    return weights;
}

} // namespace

std::vector<double> edge_alignment(const TriMesh& mesh, const MeshTopology& topology,
                                   const Points& tangents) {
    std::vector<double> along;
    for (std::size_t e = 0; e < tangents.size(); ++e) {
        const Edge& edge = topology.edges()[e];
        const Vec3 u = mesh.positions[static_cast<std::size_t>(edge.b)] -
                       mesh.positions[static_cast<std::size_t>(edge.a)];
        const double length = u.norm(), c = length > 0.0 ? u.dot(tangents[e]) / length : 0.0;
        along.push_back(std::min(1.0, c * c));
    }
    return along;
}

std::vector<double> muscle_bone_shares(const Muscle& muscle, const MeshTopology& topology,
                                       const std::vector<Attachment>& attachments, std::size_t bones) {
    if (attachments.empty())
        return {};
    std::vector<bool> fixed(muscle.mesh->positions.size(), false);
    std::vector<double> values(fixed.size() * bones, 0.0);
    for (const Attachment& attachment : attachments)
        for (const int v : attachment.vertices) {
            fixed[static_cast<std::size_t>(v)] = true;
            values[static_cast<std::size_t>(v) * bones + static_cast<std::size_t>(attachment.bone)] = 1.0;
        }
    return solve_harmonic(*muscle.mesh, topology, fixed, values, static_cast<int>(bones));
}

std::vector<double> muscle_carry_weights(const Muscle& muscle, std::vector<double> shares,
                                         const std::vector<BoneQuery>& bones) {
    if (std::none_of(bones.begin(), bones.end(), [](const BoneQuery& b) { return b.moves; }))
        return {};
    if (shares.empty())
        return weights_by_distance(muscle, bones);
    for (std::size_t k = 0; k < shares.size(); ++k)
        if (!bones[k % bones.size()].moves)
            shares[k] = 0.0;
    return shares;
}

} // namespace fascicle
