#include "fascicle/scene/muscle_stiffness.hpp"

#include "fascicle/anatomy/anisotropy.hpp"
#include "fascicle/anatomy/harmonic_field.hpp"

namespace fascicle {

namespace {

/// The fibres as polylines at rest.
Polylines polylines_of(const FibreSet& fibres) {
    Polylines lines;
    lines.points = fibres.points;
    const int n = fibres.segments + 1;
    for (int f = 0; f < fibres.count; ++f) {
        std::vector<int>& line = lines.lines.emplace_back();
        for (int j = 0; j < n; ++j)
            line.push_back(f * n + j);
    }
    return lines;
}

} // namespace

std::vector<double> origin_to_insertion_field(const Scene& scene, const Muscle& muscle,
                                              const MeshTopology& topology,
                                              const std::vector<Attachment>& attachments) {
    std::vector<bool> fixed(muscle.mesh->positions.size(), false);
    std::vector<double> values(fixed.size(), 0.0);
    bool low = false, high = false;
    for (const Attachment& attachment : attachments) {
        const double value = attachment_end(scene, attachment) == AttachmentKind::insertion ? 1.0 : 0.0;
        (value > 0.5 ? high : low) = true;
        for (const int v : attachment.vertices) {
            fixed[static_cast<std::size_t>(v)] = true;
            values[static_cast<std::size_t>(v)] = value;
        }
    }
    if (!low || !high)
        return {};
    return solve_harmonic(*muscle.mesh, topology, fixed, values, 1);
}

Points muscle_edge_tangents(const Scene& scene, const Muscle& muscle, const MeshTopology& topology,
                            const std::vector<Attachment>& attachments, const FibreModel* fibres,
                            bool harmonic) {
    if (muscle.surface_fibres)
        return edge_tangents_from_fibres(*muscle.mesh, topology, *muscle.surface_fibres);
    if (fibres != nullptr)
        return edge_tangents_from_fibres(*muscle.mesh, topology, polylines_of(fibres->rest));
    if (!harmonic)
        return {};
    const std::vector<double> field = origin_to_insertion_field(scene, muscle, topology, attachments);
    return field.empty() ? Points{} : edge_tangents_from_field(*muscle.mesh, topology, field);
}

double softened_stiffness(double stiffness, double softness, bool classic) {
    const double softened = stiffness * softness;
    return classic ? softened : softened > 0.0 ? softened / (1.0 - stiffness + softened) : 0.0;
}

std::vector<double> edge_stiffness(const Scene& scene, const Muscle& muscle, const MeshTopology& topology,
                                   const std::vector<Attachment>& attachments, const FibreModel* fibres) {
    const bool classic = scene.parameters.get_choice("solver.method") == "classic";
    const double stiffness = scene.parameters.get("solver.stiffness"),
                 anisotropy = scene.parameters.get("solver.anisotropy");
    std::vector<double> values(topology.edges().size(), softened_stiffness(stiffness, 1.0, classic));
    if (!(anisotropy > 0.0))
        return values;
    // The classic method, as published, has no fibres but those that it is given.
    const Points tangents = muscle_edge_tangents(scene, muscle, topology, attachments, fibres, !classic);
    if (tangents.empty())
        return values;
    const std::vector<double> softness = edge_softness(*muscle.mesh, topology, tangents, anisotropy);
    for (std::size_t e = 0; e < values.size(); ++e)
        values[e] = softened_stiffness(stiffness, softness[e], classic);
    return values;
}

} // namespace fascicle
