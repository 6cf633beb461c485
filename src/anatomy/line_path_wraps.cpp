// How wrap objects bend the path of a line muscle: which segment each of them takes.

#include "fascicle/anatomy/line_path.hpp"

#include <cmath>
#include <limits>
#include <numeric>

namespace fascicle {
namespace {

constexpr int most_rounds = 60;
constexpr double settled = 1e-12; // m

} // namespace

void LinePathSolver::remove_wrap(int wrap) {
    std::erase_if(path_.nodes, [wrap](const PathNode& node) { return node.wrap == wrap; });
}

WrapOutcome LinePathSolver::apply_wrap(int wrap, const Posture& posture, std::span<const char> active) {
    remove_wrap(wrap);
    const PathWrap& rule = muscle_->wraps[static_cast<std::size_t>(wrap)];
    const WrapObject& object = model_.wrap_objects[static_cast<std::size_t>(rule.object)];
    if (!object.active)
        return WrapOutcome::none;
    // The first and the last active point of the rule's range, as nodes.
    int first = rule.first, last = rule.last;
    while (first <= last && active[static_cast<std::size_t>(first)] == 0)
        ++first;
    while (last >= first && active[static_cast<std::size_t>(last)] == 0)
        --last;
    int start = -1, end = -1;
    for (std::size_t i = 0; i < path_.nodes.size(); ++i) {
        if (path_.nodes[i].point == first)
            start = static_cast<int>(i);
        if (path_.nodes[i].point == last)
            end = static_cast<int>(i);
    }
    if (first > last || start < 0 || end < 0)
        return WrapOutcome::none;

    const Pose pose = posture.poses[static_cast<std::size_t>(object.body)].after(object.pose);
    WrapOutcome outcome = WrapOutcome::none;
    WrapContact best;
    int best_segment = -1;
    double least = std::numeric_limits<double>::infinity();
    for (int i = start; i < end; ++i) {
        const PathNode &a = path_.nodes[static_cast<std::size_t>(i)],
                       &b = path_.nodes[static_cast<std::size_t>(i) + 1];
        if (a.wrap >= 0 && a.wrap == b.wrap) // lies on another object
            continue;
        const Vec3 p = pose.apply_inverse(a.position), q = pose.apply_inverse(b.position);
        const WrapContact contact = wrap_segment(object.surface, p, q, nullptr);
        outcome = contact.outcome;
        if (!contact.wraps())
            continue;
        const double longer = (contact.first - p).norm() + contact.surface_length +
                              (contact.second - q).norm() - (q - p).norm();
        if (contact.outcome == WrapOutcome::mandatory || longer < least) {
            best = contact;
            best_segment = i;
            least = longer;
        }
        if (contact.outcome == WrapOutcome::mandatory)
            break;
    }
    if (best_segment < 0)
        return outcome;
    PathNode node;
    node.body = object.body;
    node.wrap = wrap;
    node.position = pose.apply(best.first);
    const auto place = path_.nodes.begin() + best_segment + 1;
    PathNode second = node;
    second.position = pose.apply(best.second);
    second.surface_length = best.surface_length;
    path_.nodes.insert(path_.nodes.insert(place, second), node);
    return outcome;
}

void LinePathSolver::apply_wraps(const Posture& posture, std::span<const char> active) {
    const std::size_t count = muscle_->wraps.size();
    if (count == 0)
        return;
    order_.resize(count);
    std::iota(order_.begin(), order_.end(), 0);
    double last_length = std::numeric_limits<double>::infinity();
    for (int round = 0; round < (count == 1 ? 1 : most_rounds); ++round) {
        WrapOutcome first_two[2] = {WrapOutcome::none, WrapOutcome::none};
        for (std::size_t i = 0; i < count; ++i) {
            const WrapOutcome outcome = apply_wrap(order_[i], posture, active);
            if (i < 2)
                first_two[i] = outcome;
        }
        const double length = path_length();
        if (std::abs(length - last_length) < settled)
            return;
        last_length = length;
        if (round == 0 && first_two[0] == WrapOutcome::none && first_two[1] == WrapOutcome::inside) {
            std::swap(order_[0], order_[1]);
            remove_wrap(0);
        }
    }
}

} // namespace fascicle
