#include "fascicle/simulation/prepare.hpp"

#include "fascicle/anatomy/anisotropy.hpp"
#include "fascicle/base/parallel.hpp"
#include "fascicle/geometry/bvh.hpp"
#include "fascicle/geometry/grid_codec.hpp"
#include "fascicle/geometry/volume.hpp"
#include "fascicle/simulation/muscle_fibres.hpp"
#include "simulation/bone_overlap.hpp"
#include "simulation/clean_up.hpp"
#include "simulation/muscle_fields.hpp"
#include "simulation/resolve_attachments.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace fascicle {

namespace {

constexpr double least_overlap_mm = 0.1; // as for penetrating vertices

/// Hands the time since the last call to a stage.
class Lap {
public:
    explicit Lap(std::map<std::string, double>& seconds) : seconds_(seconds) {}
    void end(const char* stage) {
        const auto now = std::chrono::steady_clock::now();
        seconds_[stage] += std::chrono::duration<double>(now - start_).count();
        start_ = now;
    }

private:
    std::map<std::string, double>& seconds_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::string millimetres(double length) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f mm", length);
    return text;
}

struct PreparedBones {
    std::vector<TriangleBvh> trees;
    std::vector<BoneQuery> queries;
    std::vector<std::shared_ptr<const DistanceGrid>> grids; ///< empty when the method needs none
};

DistanceGridOptions grid_options(const Scene& scene, int threads) {
    const double unit_mm = millimetres_per_unit(scene.unit);
    DistanceGridOptions options;
    options.spacing = scene.parameters.get("contact.grid_mm") / unit_mm;
    options.saturation = 8.0 * std::max(1.0, scene.parameters.get("contact.grid_mm")) / unit_mm;
    options.threads = threads;
    return options;
}

/// Null when the cache (which may be null) has none.
std::shared_ptr<const DistanceGrid> find_grid(const TriMesh& mesh, const DistanceGridOptions& options,
                                              BlobStore* cache) {
    if (cache != nullptr)
        if (const auto bytes = cache->find(grid_key(mesh, options)))
            if (auto grid = decode_grid(*bytes, options.max_nodes))
                return std::make_shared<const DistanceGrid>(std::move(*grid));
    return nullptr;
}

/// Makes the grids that are still missing, one after the other, each on all threads.
void make_grids(const Scene& scene, const DistanceGridOptions& options, const JobControl& control,
                BlobStore* cache, PreparedBones& bones) {
    for (std::size_t b = 0; b < scene.bones.size(); ++b) {
        if (bones.grids[b] != nullptr)
            continue;
        JobControl part = control;
        part.report = [&](std::string_view, double f) {
            if (control.report)
                control.report("prepare", 0.1 + 0.7 * (double(b) + f) / double(scene.bones.size()));
        };
        bones.grids[b] = std::make_shared<const DistanceGrid>(*scene.bones[b].mesh, options, part);
        if (cache != nullptr)
            cache->keep(grid_key(*scene.bones[b].mesh, options), encode_grid(*bones.grids[b]));
    }
}

PreparedBones prepare_bones(const Scene& scene, bool grids, int threads, const JobControl& control,
                            BlobStore* cache, std::vector<std::string>& notes, Lap& lap) {
    const std::size_t count = scene.bones.size();
    PreparedBones bones;
    bones.trees.resize(count);
    bones.grids.resize(grids ? count : 0);
    const DistanceGridOptions options = grid_options(scene, threads);
    // Trees, and grids as far as they are found in the cache: side by side, since each is work for one thread.
    parallel_for(threads, count + bones.grids.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            if (control.cancelled())
                throw Cancelled();
            else if (i < count)
                bones.trees[i] = TriangleBvh(*scene.bones[i].mesh);
            else
                bones.grids[i - count] = find_grid(*scene.bones[i - count].mesh, options, cache);
    });
    control.checkpoint("prepare", 0.1);
    for (std::size_t b = 0; b < count; ++b) {
        const bool moves = scene.timeline.moves(static_cast<int>(b));
        bones.queries.push_back(
            {[tree = &bones.trees[b]](const Vec3& p, double limit) {
                 return std::sqrt(tree->closest(p, limit * (1.0 + 1e-12)).squared_distance);
             },
             moves,
             [mesh = scene.bones[b].mesh,
              graph = std::make_shared<std::unique_ptr<const SurfaceGraph>>()]() -> const SurfaceGraph& {
                 if (*graph == nullptr) // muscles are prepared one after the other
                     *graph = std::make_unique<const SurfaceGraph>(mesh);
                 return **graph;
             }});
    }
    lap.end("trees");
    if (!grids)
        return bones;
    make_grids(scene, options, control, cache, bones);
    for (std::size_t b = 0; b < count; ++b)
        if (bones.grids[b]->spacing() > 1.01 * options.spacing) {
            const double unit_mm = millimetres_per_unit(scene.unit);
            notes.push_back(scene.bones[b].name + ": distance grid of " +
                            millimetres(bones.grids[b]->spacing() * unit_mm) + " instead of the wanted " +
                            millimetres(options.spacing * unit_mm) + ", to stay within memory");
        }
    lap.end("grids");
    return bones;
}

void report_overlaps(const Scene& scene, const PreparedBones& bones, const JobControl& control,
                     std::vector<std::string>& notes) {
    std::vector<OverlapBone> solids;
    for (std::size_t b = 0; b < bones.grids.size(); ++b)
        solids.push_back({scene.bones[b].mesh.get(), &bones.trees[b], bones.grids[b].get()});
    const double least = least_overlap_mm / millimetres_per_unit(scene.unit);
    for (const BoneOverlap& overlap : find_bone_overlaps(solids, scene.timeline, least, control))
        notes.push_back(overlap_note(scene, overlap));
}

void describe_attachments(const Scene& scene, const Muscle& muscle,
                          const std::vector<Attachment>& attachments, std::vector<std::string>& notes) {
    for (const Attachment& a : attachments)
        notes.push_back(muscle.name + ": " + to_text(a.kind) + " on '" +
                        scene.bones[static_cast<std::size_t>(a.bone)].name + "', " +
                        std::to_string(a.vertices.size()) + " of " +
                        std::to_string(muscle.mesh->vertex_count()) + " vertices attached");
}

PreparedMuscle prepare_muscle(const Scene& scene, const Muscle& muscle, const SolverMethod& method,
                              const PreparedBones& bones, int threads, std::vector<std::string>& notes) {
    const double unit_mm = millimetres_per_unit(scene.unit);
    const MeshTopology topology(muscle.mesh->vertex_count(), muscle.mesh->triangles);
    if (!(signed_volume(muscle.mesh->positions, muscle.mesh->triangles) > 0.0))
        throw_error(muscle.name, "the surface encloses no volume", "a closed muscle surface facing outwards");

    PreparedMuscle prepared;
    // The published program fixes what collides at the start; only areas, outlines or explicit attachments replace that.
    prepared.attachments =
        resolve_attachments(scene, muscle, topology, bones.queries, method.needs_grid, notes);
    std::vector<const DistanceGrid*> grids;
    for (const auto& grid : bones.grids)
        grids.push_back(grid.get());
    if (method.needs_grid) {
        const int released = release_swept_attachments(prepared.attachments, muscle.mesh->positions,
                                                       scene.timeline, grids, sweep_clearance_mm / unit_mm);
        if (released > 0)
            notes.push_back(muscle.name + ": " + std::to_string(released) +
                            " attached vertices released, another bone comes nearer than 0.5 mm to them");
    }
    describe_attachments(scene, muscle, prepared.attachments, notes);

    SoftBodyProblem& problem = prepared.problem;
    problem.parameters = scene.parameters;
    problem.unit_mm = unit_mm;
    problem.body_of_vertex.assign(muscle.mesh->positions.size(), -1);
    for (const Attachment& a : prepared.attachments)
        for (const int v : a.vertices)
            problem.body_of_vertex[static_cast<std::size_t>(v)] = a.bone;
    if (std::find(problem.body_of_vertex.begin(), problem.body_of_vertex.end(), -1) ==
        problem.body_of_vertex.end())
        throw_error(muscle.name, "every vertex is attached to a bone", "some vertices that are free to move");

    auto surface = std::make_shared<TriMesh>(*muscle.mesh);
    if (method.needs_grid) {
        const double offset = scene.parameters.get("contact.offset_mm") / unit_mm;
        const CleanUpResult result =
            push_out_at_rest(surface->positions, problem.body_of_vertex, grids, offset);
        if (result.moved > 0)
            notes.push_back(muscle.name + ": " + std::to_string(result.moved) +
                            " free vertices moved off the bones at rest, by at most " +
                            millimetres(result.largest_shift * unit_mm));
        if (result.still_inside > 0)
            notes.push_back(muscle.name + ": " + std::to_string(result.still_inside) +
                            " free vertices lie too deep inside a bone to be moved out");
    }
    problem.surface = surface;
    for (std::size_t b = 0; b < scene.bones.size(); ++b)
        problem.solids.push_back({scene.bones[b].mesh, method.needs_grid ? bones.grids[b] : nullptr});

    prepared.fibres = make_fibres(scene, muscle, *surface, topology, prepared.attachments, threads);
    if (prepared.fibres != nullptr)
        for (const std::string& note : prepared.fibres->notes)
            notes.push_back(muscle.name + ": " + note);
    const double anisotropy = scene.parameters.get("solver.anisotropy");
    const Points tangents = muscle_edge_tangents(scene, muscle, topology, prepared.attachments,
                                                 prepared.fibres.get(), method.needs_grid);
    if (anisotropy > 0.0 && !tangents.empty())
        problem.edge_softness = edge_softness(*muscle.mesh, topology, tangents, anisotropy);
    // xpbd needs them for its tone alone, rivals with tetrahedra read their fibres from them.
    if (method.needs_grid && (scene.parameters.get("solver.tone") > 0.0 || method.name != "xpbd"))
        problem.edge_along = edge_alignment(*muscle.mesh, topology, tangents);
    if (problem.edge_softness.empty() && scene.parameters.get("solver.anisotropy") > 0.0)
        notes.push_back(muscle.name + ": no fibres and no pair of attachments, so it is isotropic");
    if (method.needs_grid) {
        prepared.bone_shares = muscle_bone_shares(muscle, topology, prepared.attachments, scene.bones.size());
        problem.carry_weights = muscle_carry_weights(muscle, prepared.bone_shares, bones.queries);
    }
    return prepared;
}

} // namespace

PreparedScene prepare_scene(const Scene& scene, int threads, const JobControl& control, BlobStore* cache) {
    PreparedScene prepared;
    prepared.method = find_solver_method(scene.parameters.get_choice("solver.method"));
    if (prepared.method == nullptr)
        throw_error("solver.method", "no method '" + scene.parameters.get_choice("solver.method") + "'");
    if (scene.muscles.empty())
        throw_error(scene.name, "the scene has no muscle", "at least one muscle");
    control.checkpoint("prepare", 0.0);
    Lap lap(prepared.stage_seconds);
    const PreparedBones bones =
        prepare_bones(scene, prepared.method->needs_grid, threads, control, cache, prepared.notes, lap);
    report_overlaps(scene, bones, control, prepared.notes);
    lap.end("overlaps");
    for (std::size_t m = 0; m < scene.muscles.size(); ++m) {
        control.checkpoint("prepare", 0.8 + 0.2 * double(m) / double(scene.muscles.size()));
        prepared.muscles.push_back(
            prepare_muscle(scene, scene.muscles[m], *prepared.method, bones, threads, prepared.notes));
        prepared.muscles.back().problem.threads = scene.muscles.size() == 1 ? threads : 1;
    }
    lap.end("muscles");
    control.checkpoint("prepare", 1.0);
    return prepared;
}

} // namespace fascicle
