#pragma once
// The simulated fibres of a muscle over a run, in the model's axes, a part of them at a time.

#include "io/osim_export/bake_fibre.hpp"

#include <functional>

namespace fascicle::io {

class FibreCourses {
public:
    /// The muscle has fibres. motion and recording outlive this.
    FibreCourses(const Recording& recording, const BakedMotion& motion, const ToModel& to_model, int muscle);

    int count() const { return model_->rest.count; }
    /// Calls use(first fibre, courses) for all fibres, part by part, so that never more than about 64 MB are held.
    void
    for_each_part(const JobControl& control,
                  const std::function<void(int first, const std::vector<FibreCourse>& courses)>& use) const;

private:
    void set_bodies(int fibre, FibreCourse& course) const;

    const Recording& recording_;
    const BakedMotion& motion_;
    ToModel to_model_;
    std::size_t muscle_;
    FibreModelPtr model_;
    std::vector<Attachment> attachments_;
    FibreSet rest_; ///< of frame 0, scene units
};

} // namespace fascicle::io
