#pragma once
// Anything whose frames can be timed: our solvers and their rivals.

#include "fascicle/simulation/scene_solver.hpp"

#include <functional>
#include <optional>

namespace fascicle::bench {

class BenchBody {
public:
    virtual ~BenchBody() = default;
    /// One frame; poses of the bones from rest.
    virtual void advance(std::span<const Pose> from, std::span<const Pose> to) = 0;
    virtual std::vector<Points> positions() const = 0;
    virtual std::map<std::string, double> stage_seconds() const { return {}; }
    virtual std::optional<std::size_t> state_bytes() const { return std::nullopt; }
};

using MakeBody = std::function<std::unique_ptr<BenchBody>()>;

} // namespace fascicle::bench
