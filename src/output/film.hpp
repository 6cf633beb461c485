#pragma once
// Where pictures of a film go, one after another. Used by one thread at a time.

#include "fascicle/base/job_control.hpp"
#include "output/export_kinds.hpp"
#include "render/draw_list.hpp"

#include "fascicle/scene/recording.hpp"

namespace fascicle::output {

class Film {
public:
    virtual ~Film() = default; ///< without finish() nothing is left behind
    /// Small pictures that are wanted before the first one, spread over the film: to choose colours from.
    virtual int samples() const { return 0; }
    virtual void sample(const render::Image&) {}
    /// All of one size. frame: its number, for names.
    virtual void add(const render::Image& image, int frame) = 0;
    virtual void finish(const JobControl& control) = 0;
};

/// Error naming the target, e.g. when there is no encoder.
std::unique_ptr<Film> make_film(const ExportRequest& request, ScenePtr scene,
                                const std::atomic<bool>* cancel);

} // namespace fascicle::output
