#pragma once
// Undo by snapshots: a list of immutable values with a name each, capped by count and by bytes.

#include "fascicle/base/assert.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace fascicle {

struct HistoryLimits {
    std::size_t steps = 200; ///< values kept, the present one included; at least 1
    std::size_t bytes = std::size_t{512}
                        << 20; ///< of what the kept values do not share with their predecessor
};

/// One value is the present one (head). Undo and redo move the head; a commit drops what could be redone.
template <class T>
class History {
public:
    using Ptr = std::shared_ptr<const T>;
    /// Bytes of `value` that it does not share with the step before it.
    using Cost = std::function<std::size_t(const T& value, const T& previous)>;
    struct Step {
        Ptr value;
        std::string name; ///< what the user did, e.g. "Set edge stiffness"
        std::size_t bytes = 0;
    };

    History(Ptr first, std::string name, Cost cost = {}, HistoryLimits limits = {})
        : limits_(limits), cost_(std::move(cost)) {
        FASCICLE_ASSERT(first != nullptr && limits.steps > 0);
        steps_.push_back({std::move(first), std::move(name), 0});
    }

    const Ptr& head() const { return steps_[position_].value; }
    const std::vector<Step>& steps() const { return steps_; } ///< oldest first
    std::size_t position() const { return position_; }        ///< index of the head in steps()

    /// The oldest steps go when a limit is passed; the head stays whatever it weighs.
    void commit(Ptr value, std::string name) {
        FASCICLE_ASSERT(value != nullptr);
        steps_.resize(position_ + 1);
        const std::size_t bytes = cost_ ? cost_(*value, *head()) : 0;
        steps_.push_back({std::move(value), std::move(name), bytes});
        while (steps_.size() > 1 && (steps_.size() > limits_.steps || total_bytes() > limits_.bytes))
            steps_.erase(steps_.begin());
        position_ = steps_.size() - 1;
    }

    bool can_undo() const { return position_ > 0; }
    bool can_redo() const { return position_ + 1 < steps_.size(); }
    /// What undo would take back, or redo would do again; empty when it cannot.
    std::string undo_name() const { return can_undo() ? steps_[position_].name : std::string(); }
    std::string redo_name() const { return can_redo() ? steps_[position_ + 1].name : std::string(); }
    bool undo() { return can_undo() && jump(position_ - 1); }
    bool redo() { return can_redo() && jump(position_ + 1); }
    /// Makes any step the head; false when there is no such step or it is the head already.
    bool jump(std::size_t step) {
        if (step >= steps_.size() || step == position_)
            return false;
        position_ = step;
        return true;
    }

private:
    /// The first kept step is paid for by the scene itself, not by the history.
    std::size_t total_bytes() const {
        std::size_t sum = 0;
        for (std::size_t i = 1; i < steps_.size(); ++i)
            sum += steps_[i].bytes;
        return sum;
    }

    HistoryLimits limits_;
    Cost cost_;
    std::vector<Step> steps_;
    std::size_t position_ = 0;
};

} // namespace fascicle
