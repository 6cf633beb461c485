#pragma once
// How long work talks to whoever waits for it: progress out, a wish to stop in. Both optional.

#include "fascicle/base/error.hpp"

#include <atomic>
#include <functional>
#include <string_view>

namespace fascicle {

struct JobControl {
    /// Called from the working thread with the stage's name and its share done, 0 to 1.
    std::function<void(std::string_view stage, double fraction)> report;
    /// Set by anybody to ask the work to stop; may be null.
    const std::atomic<bool>* cancel = nullptr;

    bool cancelled() const { return cancel != nullptr && cancel->load(std::memory_order_relaxed); }
    /// Reports progress, and throws Cancelled when asked to stop.
    void checkpoint(std::string_view stage, double fraction) const {
        if (cancelled())
            throw Cancelled();
        if (report)
            report(stage, fraction);
    }
};

} // namespace fascicle
