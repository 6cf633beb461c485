#pragma once
// What is under the pointer.

#include "view/build_draw_list.hpp"

namespace fascicle::editor {

struct Hit {
    int bone = -1;   ///< index of the scene, or -1
    int muscle = -1; ///< index of the scene, or -1
    Vec3 point = Vec3::Zero();
    double distance = 0; ///< along the ray, scene units
};

/// The nearest visible surface that the ray meets, from either side. Looks at every triangle: for clicks, not for
/// every move of the pointer.
std::optional<Hit> pick(const view::ViewSubject& subject, const view::ViewOptions& options,
                        const view::Ray& ray);

} // namespace fascicle::editor
