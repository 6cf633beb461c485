#include "io/osim_export/fibre_courses.hpp"

#include "fascicle/metrics/moment_arm.hpp"

#include <algorithm>
#include <limits>

namespace fascicle::io {

FibreCourses::FibreCourses(const Recording& recording, const BakedMotion& motion, const ToModel& to_model,
                           int muscle)
    : recording_(recording), motion_(motion), to_model_(to_model), muscle_(static_cast<std::size_t>(muscle)),
      model_(recording.fibres().at(muscle_)), rest_(model_->rest) {
    const auto attachments = recording.attachments();
    if (muscle_ < attachments.size())
        attachments_ = attachments[muscle_];
    model_->carrier.carry(*recording.frame(0)->muscle_positions[muscle_], rest_.points);
}

/// An end belongs to the bone that the nearest attached vertex is attached to.
void FibreCourses::set_bodies(int fibre, FibreCourse& course) const {
    const Points& vertices = *recording_.frame(0)->muscle_positions[muscle_];
    const std::span<const Vec3> points = rest_.fibre(fibre);
    const auto body_at = [&](const Vec3& end) {
        double nearest = std::numeric_limits<double>::infinity();
        int body = -1;
        for (const Attachment& a : attachments_)
            for (const int v : a.vertices)
                if (const double d = (vertices[static_cast<std::size_t>(v)] - end).squaredNorm(); d < nearest)
                    nearest = d, body = a.bone + 1;
        return body;
    };
    course.origin_body = body_at(points.front());
    course.insertion_body = body_at(points.back());
}

void FibreCourses::for_each_part(
    const JobControl& control,
    const std::function<void(int first, const std::vector<FibreCourse>& courses)>& use) const {
    const std::size_t per_fibre = rest_.points_per_fibre();
    const auto frames = static_cast<std::size_t>(recording_.frame_count());
    const std::size_t fitted = motion_.fitted.size();
    const std::size_t bytes = per_fibre * fitted * sizeof(Vec3) + frames * 3 * sizeof(double);
    const int part = static_cast<int>(std::max<std::size_t>(1, (std::size_t{64} << 20) / bytes));
    std::vector<int> row_of(frames, -1);
    for (std::size_t i = 0; i < fitted; ++i)
        row_of[static_cast<std::size_t>(motion_.fitted[i])] = static_cast<int>(i);
    Points points(rest_.points.size());
    for (int first = 0; first < count(); first += part) {
        const int size = std::min(part, count() - first);
        std::vector<FibreCourse> courses(static_cast<std::size_t>(size));
        for (int f = 0; f < size; ++f) {
            FibreCourse& course = courses[static_cast<std::size_t>(f)];
            course.points = per_fibre;
            course.places.resize(per_fibre * fitted);
            course.lengths.resize(fitted);
            set_bodies(first + f, course);
        }
        std::vector<double> lengths(frames * static_cast<std::size_t>(size));
        for (std::size_t k = 0; k < frames; ++k) {
            control.checkpoint("OpenSim model", double(k) / double(frames));
            model_->carrier.carry(*recording_.frame(static_cast<int>(k))->muscle_positions[muscle_], points);
            for (int f = 0; f < size; ++f) {
                FibreCourse& course = courses[static_cast<std::size_t>(f)];
                const Vec3* fibre = points.data() + static_cast<std::size_t>(first + f) * per_fibre;
                double length = 0;
                for (std::size_t j = 0; j + 1 < per_fibre; ++j)
                    length += (fibre[j + 1] - fibre[j]).norm();
                length *= to_model_.scale;
                lengths[k * static_cast<std::size_t>(size) + static_cast<std::size_t>(f)] = length;
                course.all_lengths.push_back(length);
                if (row_of[k] < 0)
                    continue;
                const auto row = static_cast<std::size_t>(row_of[k]);
                course.lengths[row] = length;
                for (std::size_t j = 0; j < per_fibre; ++j)
                    course.places[row * per_fibre + j] = to_model_.point(fibre[j]);
            }
        }
        if (motion_.kind == OsimCoordinate::joint) {
            // Of the span alone: as fibres.csv, but for a first frame that belongs to the span before.
            const auto from = static_cast<std::size_t>(motion_.span_first);
            const std::size_t span = static_cast<std::size_t>(motion_.span_last) - from + 1;
            const auto columns = static_cast<std::size_t>(size);
            const std::vector<double> arms = excursion_arms(
                std::span(motion_.angles_rad).subspan(from, span),
                std::span(lengths).subspan(from * columns, span * columns), size, motion_.sign);
            for (std::size_t f = 0; f < columns; ++f)
                for (const int k : motion_.fitted)
                    courses[f].arms.push_back(arms[(static_cast<std::size_t>(k) - from) * columns + f]);
        }
        use(first, courses);
    }
}

} // namespace fascicle::io
