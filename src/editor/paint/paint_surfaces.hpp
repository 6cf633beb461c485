#pragma once
// What painting needs of a bone, built once and in the background: neighbours, tree, workspace of the searches.

#include "fascicle/scene/outline_areas.hpp"

#include <future>
#include <set>

namespace fascicle::editor {

/// Until a mesh is ready nothing can be painted on it. update() takes what the thread has made.
class PaintSurfaces {
public:
    ~PaintSurfaces() { finish(); }
    /// Begins to build those that are missing. Short waits are waited out (small bones need no second frame).
    void want(const std::vector<MeshPtr>& meshes);
    void update();
    /// Null while it is being built or was never wanted.
    BoneSurfaces* ready(const MeshPtr& mesh);
    bool busy() const { return job_.valid(); }
    void finish(); ///< waits
    void forget(); ///< waits, then drops everything

private:
    std::set<MeshPtr> built_, building_;
    BoneSurfaces surfaces_; ///< with the thread while busy
    std::future<BoneSurfaces> job_;
};

} // namespace fascicle::editor
