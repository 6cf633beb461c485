#include "fascicle/simulation/muscle_fibres.hpp"

#include "fascicle/anatomy/fibre_methods.hpp"
#include "fascicle/base/error.hpp"

#include <algorithm>

namespace fascicle {

namespace {

bool bone_moves(const Scene& scene, int bone) {
    const auto b = static_cast<std::size_t>(bone);
    return b < scene.timeline.bone_tracks.size() && scene.timeline.bone_tracks[b].moves();
}

/// Of the muscle's own template file, else of those that come with the program.
const FibreTemplate* find_template(const Scene& scene, const Muscle& muscle) {
    if (muscle.fibre_template != nullptr)
        return muscle.fibre_template.get();
    const std::string& key = scene.parameters.get_choice("fibres.template");
    if (scene.fibre_templates != nullptr)
        for (const FibreTemplate& row : *scene.fibre_templates)
            if (row.key == key)
                return &row;
    if (key == parallel_template().key)
        return &parallel_template();
    throw_error("fibres.template", "template '" + key + "' is not loaded", "the program's resources");
}

} // namespace

std::vector<AttachmentPatch> fibre_patches(const Scene& scene, const Muscle& muscle,
                                           const std::vector<Attachment>& attachments) {
    std::vector<AttachmentPatch> patches;
    for (const Attachment& attachment : attachments) {
        if (attachment.bone < 0 || attachment.vertices.empty())
            continue;
        AttachmentPatch patch;
        patch.kind = attachment.kind;
        if (patch.kind == AttachmentKind::unknown)
            patch.kind =
                bone_moves(scene, attachment.bone) ? AttachmentKind::insertion : AttachmentKind::origin;
        patch.vertices = attachment.vertices;
        patch.name = std::string(to_text(patch.kind)) + " on '" +
                     scene.bones[static_cast<std::size_t>(attachment.bone)].name + "'";
        patches.push_back(std::move(patch));
    }
    // An outline belongs to a patch when it is the only one of its kind, and so is the patch.
    for (AttachmentPatch& patch : patches) {
        if (!muscle.attachments.empty() || has_painted_areas(muscle))
            break; // the outlines are not what these came from
        const auto same = [&](const auto& other) { return other.kind == patch.kind; };
        if (std::count_if(patches.begin(), patches.end(), same) != 1 ||
            std::count_if(muscle.outlines.begin(), muscle.outlines.end(), same) != 1)
            continue;
        patch.outline = std::find_if(muscle.outlines.begin(), muscle.outlines.end(), same)->points;
    }
    return patches;
}

FibreModelPtr make_fibres(const Scene& scene, const Muscle& muscle, const TriMesh& rest,
                          const MeshTopology& topology, const std::vector<Attachment>& attachments,
                          int threads) {
    const std::string& key = scene.parameters.get_choice("fibres.method");
    if (key == "none")
        return nullptr;
    const auto& methods = fibre_methods();
    const auto method =
        std::find_if(methods.begin(), methods.end(), [&](const FibreMethod& m) { return key == m.key; });
    if (method == methods.end())
        throw_error("fibres.method", "no method '" + key + "'");
    FibreProblem problem;
    problem.muscle = muscle.name;
    problem.surface = &rest;
    problem.topology = &topology;
    problem.patches = fibre_patches(scene, muscle, attachments);
    problem.unit_mm = millimetres_per_unit(scene.unit);
    problem.count = scene.parameters.get_int("fibres.count");
    problem.segments = scene.parameters.get_int("fibres.segments");
    problem.threads = threads;
    if (method->needs_template)
        problem.fibre_template = find_template(scene, muscle);
    if (method->needs_surface_fibres) {
        problem.surface_fibres = muscle.surface_fibres.get();
        if (problem.surface_fibres == nullptr)
            throw_error(muscle.name,
                        std::string("no superficial fibres, which fibres.method=") + key + " needs",
                        "--surface-fibres " + muscle.name + "=FILE, or another method");
    }
    return std::make_shared<const FibreModel>(method->function(problem));
}

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

} // namespace fascicle
