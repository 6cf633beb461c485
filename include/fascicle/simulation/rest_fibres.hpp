#pragma once
// Fibres of a scene's muscles at rest without preparing a run: no distance grids, no clean-up of vertices inside bones.

#include "fascicle/simulation/muscle_fibres.hpp"

#include <memory>

namespace fascicle {

/// For one scene, which must outlive it. Search trees of the bones are made when an attachment has to be found, and kept.
class RestFibres {
public:
    explicit RestFibres(const Scene& scene);
    ~RestFibres();
    RestFibres(const RestFibres&) = delete;
    RestFibres& operator=(const RestFibres&) = delete;

    /// As make_fibres(), for the mesh of the scene's muscle and the attachments that a run would find. Null when
    /// fibres.method is "none".
    FibreModelPtr make(std::size_t muscle, int threads);

private:
    struct Bones;
    const Scene& scene_;
    std::unique_ptr<Bones> bones_;
};

} // namespace fascicle
