#include "simulation/attachment_guard.hpp"

#include "fascicle/geometry/distance_grid.hpp"

#include <algorithm>

namespace fascicle {

namespace {

constexpr double steepest = 1.5; // no grid's value changes faster than this times the way

} // namespace

AttachmentGuard::AttachmentGuard(const SoftBodyProblem& problem, double clearance)
    : rest_(problem.surface->positions), clearance_(clearance) {
    for (const SolidBody& solid : problem.solids) {
        if (solid.grid == nullptr)
            return; // a method without grids has no contact that could be run into
        grids_.push_back(solid.grid);
    }
    for (std::size_t i = 0; i < rest_.size(); ++i)
        for (std::size_t b = 0; b < grids_.size() && problem.body_of_vertex[i] >= 0; ++b)
            if (static_cast<int>(b) != problem.body_of_vertex[i]) {
                const double value = grids_[b]->value(rest_[i]);
                watches_.push_back({static_cast<int>(i), problem.body_of_vertex[i], static_cast<int>(b),
                                    rest_[i], (value - clearance) / steepest, value});
            }
}

const std::vector<int>& AttachmentGuard::find(std::span<const Pose> to) {
    found_.clear();
    for (Watch& watch : watches_) {
        const auto own = static_cast<std::size_t>(watch.own), other = static_cast<std::size_t>(watch.other);
        const Vec3 p = to[other].apply_inverse(to[own].apply(rest_[static_cast<std::size_t>(watch.vertex)]));
        if (watch.slack > 0.0 && (p - watch.last).squaredNorm() < watch.slack * watch.slack)
            continue;
        const double value = grids_[other]->value(p);
        watch.last = p;
        watch.slack = (value - clearance_) / steepest;
        if (value < clearance_ && value < watch.at_rest - 1e-6 * clearance_)
            found_.push_back(watch.vertex);
    }
    if (found_.empty())
        return found_;
    std::sort(found_.begin(), found_.end());
    found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
    std::erase_if(watches_, [&](const Watch& watch) {
        return std::binary_search(found_.begin(), found_.end(), watch.vertex);
    });
    return found_;
}

} // namespace fascicle
