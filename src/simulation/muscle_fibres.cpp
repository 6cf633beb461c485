#include "fascicle/simulation/muscle_fibres.hpp"

#include "fascicle/anatomy/fibre_methods.hpp"
#include "fascicle/base/error.hpp"

#include <algorithm>
#include <cstdio>
#include <limits>

namespace fascicle {

namespace {

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

/// Why a muscle has no patch of a kind, as far as its outlines tell: nothing where none was given.
void explain_missing(const Muscle& muscle, const TriMesh& rest, const std::vector<AttachmentPatch>& patches,
                     double unit_mm) {
    for (const AttachmentKind kind : {AttachmentKind::origin, AttachmentKind::insertion}) {
        const auto same = [&](const auto& other) { return other.kind == kind; };
        if (std::any_of(patches.begin(), patches.end(), same) || !muscle.attachments.empty())
            continue;
        for (const AttachmentOutline& outline : muscle.outlines) {
            if (outline.kind != kind || outline.points.empty())
                continue;
            double nearest = std::numeric_limits<double>::infinity();
            for (const Vec3& p : outline.points)
                for (const Vec3& v : rest.positions)
                    nearest = std::min(nearest, (p - v).norm());
            char distance[40];
            std::snprintf(distance, sizeof distance, "%.1f mm", nearest * unit_mm);
            const std::string what =
                std::string("the ") + to_text(kind) + " outline on '" + outline.bone + "' ";
            if (nearest * unit_mm > 5.0)
                throw_error(muscle.name, what + "is " + distance + " away from the muscle at its nearest",
                            "an outline within a few millimetres of bone and muscle");
            throw_error(muscle.name, what + "reaches no vertex of the muscle that no other attachment holds",
                        "origin and insertion at different places of the muscle, near to its surface");
        }
    }
}

} // namespace

std::vector<AttachmentPatch> fibre_patches(const Scene& scene, const Muscle& muscle,
                                           const std::vector<Attachment>& attachments) {
    std::vector<AttachmentPatch> patches;
    for (const Attachment& attachment : attachments) {
        if (attachment.bone < 0 || attachment.vertices.empty())
            continue;
        AttachmentPatch patch;
        patch.kind = attachment_end(scene, attachment);
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
    explain_missing(muscle, rest, problem.patches, problem.unit_mm);
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

} // namespace fascicle
