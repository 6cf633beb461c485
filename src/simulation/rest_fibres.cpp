#include "fascicle/simulation/rest_fibres.hpp"

#include "fascicle/geometry/bvh.hpp"
#include "simulation/resolve_attachments.hpp"

#include <cmath>

namespace fascicle {

struct RestFibres::Bones {
    explicit Bones(const Scene& scene) {
        trees.reserve(scene.bones.size());
        for (std::size_t b = 0; b < scene.bones.size(); ++b) {
            trees.emplace_back(*scene.bones[b].mesh);
            queries.push_back({[tree = &trees[b]](const Vec3& p, double limit) {
                                   return std::sqrt(tree->closest(p, limit * (1.0 + 1e-12)).squared_distance);
                               },
                               scene.timeline.moves(static_cast<int>(b)),
                               {}});
        }
    }
    std::vector<TriangleBvh> trees;
    std::vector<BoneQuery> queries;
};

RestFibres::RestFibres(const Scene& scene) : scene_(scene) {}

RestFibres::~RestFibres() = default;

FibreModelPtr RestFibres::make(std::size_t index, int threads) {
    if (scene_.parameters.get_choice("fibres.method") == "none")
        return nullptr;
    const Muscle& muscle = scene_.muscles[index];
    const MeshTopology topology(muscle.mesh->vertex_count(), muscle.mesh->triangles);
    std::vector<Attachment> attachments = muscle.attachments;
    if (attachments.empty()) {
        if (bones_ == nullptr)
            bones_ = std::make_unique<Bones>(scene_);
        std::vector<std::string> notes;
        attachments = resolve_attachments(scene_, muscle, topology, bones_->queries, true, notes);
    }
    return make_fibres(scene_, muscle, *muscle.mesh, topology, attachments, threads);
}

} // namespace fascicle
