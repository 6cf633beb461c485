// The order in which joints and couplers are worked through.

#include "fascicle/base/error.hpp"
#include "fascicle/motion/skeleton.hpp"

#include <algorithm>

namespace fascicle {
namespace {

/// Breadth is not needed: joints are passed over again and again until none fits, which keeps the model's own order where
/// that is from ground outwards already. Models have tens of bodies.
void order_joints(Skeleton& skeleton, std::vector<char>& placed, const std::string& where) {
    std::vector<char> used(skeleton.joints.size(), 0);
    skeleton.order.clear();
    placed.assign(skeleton.bodies.size(), 0);
    placed[0] = 1;
    const auto use = [&](std::size_t j) {
        const Joint& joint = skeleton.joints[j];
        char& parent = placed[static_cast<std::size_t>(joint.parent)];
        char& child = placed[static_cast<std::size_t>(joint.child)];
        if (used[j] != 0 || (parent == 0 && child == 0))
            return false;
        if (parent != 0 && child != 0)
            throw_error(where, "joint '" + joint.name + "' closes a loop of bodies",
                        "joints that form a tree from ground");
        skeleton.order.push_back({static_cast<int>(j), parent == 0});
        parent = child = used[j] = 1;
        return true;
    };
    for (bool found = true; found;) {
        found = false;
        for (std::size_t j = 0; j < skeleton.joints.size(); ++j)
            found = use(j) || found;
    }
}

void order_couplers(Skeleton& skeleton, const std::string& where) {
    std::vector<char> dependent(skeleton.coordinates.size(), 0);
    for (const CoordinateCoupler& coupler : skeleton.couplers) {
        char& mark = dependent[static_cast<std::size_t>(coupler.dependent)];
        if (mark != 0)
            throw_error(where, "two constraints tell the value of coordinate '" +
                                   skeleton.coordinates[static_cast<std::size_t>(coupler.dependent)].name +
                                   "'");
        mark = 1;
    }
    std::vector<CoordinateCoupler> rest = std::move(skeleton.couplers), sorted;
    while (!rest.empty()) {
        const auto ready = std::find_if(rest.begin(), rest.end(), [&](const CoordinateCoupler& coupler) {
            return std::all_of(
                coupler.function.terms.begin(), coupler.function.terms.end(),
                [&](const auto& term) { return dependent[static_cast<std::size_t>(term.coordinate)] == 0; });
        });
        if (ready == rest.end())
            throw_error(where,
                        "the constraint on coordinate '" +
                            skeleton.coordinates[static_cast<std::size_t>(rest.front().dependent)].name +
                            "' depends on itself through others");
        dependent[static_cast<std::size_t>(ready->dependent)] = 0;
        sorted.push_back(std::move(*ready));
        rest.erase(ready);
    }
    skeleton.couplers = std::move(sorted);
}

} // namespace

std::vector<std::string> arrange_skeleton(Skeleton& skeleton, const std::string& where) {
    for (const Joint& joint : skeleton.joints)
        if (joint.parent == joint.child)
            throw_error(where, "joint '" + joint.name + "' ties a body to itself", "two bodies");
    std::vector<char> placed;
    order_joints(skeleton, placed, where);
    order_couplers(skeleton, where);
    std::vector<std::string> notes;
    for (std::size_t b = 1; b < skeleton.bodies.size(); ++b)
        if (placed[b] == 0)
            notes.push_back("no joint ties body '" + skeleton.bodies[b].name +
                            "' to ground: it stays in ground's frame");
    return notes;
}

} // namespace fascicle
