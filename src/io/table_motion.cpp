#include "fascicle/io/table_motion.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/base/param_table.hpp"
#include "fascicle/motion/joint_track.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle {

namespace {

constexpr int most_frames = 100000;

/// Where a frame lies between two rows.
struct Place {
    std::size_t row = 0;
    double share = 0; ///< of the next row
};

class TableClock {
public:
    TableClock(const StorageTable& table, const TableTiming& timing) : table_(table), timing_(timing) {
        column_ = table.column_index("time");
        if (column_ < 0)
            throw_error(table.file, "there is no column 'time'", "a column of seconds");
        for (std::size_t r = 0; r < table.row_count(); ++r)
            if (!std::isfinite(time(r)) || (r > 0 && !(time(r) > time(r - 1))))
                throw_error(table.file + ", line " + std::to_string(table.lines[r]),
                            "the time does not ascend", "ascending seconds");
        const double frames = (time(table.row_count() - 1) - time(0)) / timing.frame_seconds;
        // The last row is a frame of its own when it lies on one, to rounding.
        if (!(frames + timing.lead_in >= 1 - 1e-9) || !(frames + timing.lead_in <= most_frames))
            throw_error(table.file, "it makes " + number_text(std::floor(frames)) + " frames",
                        "1 to 100000 frames");
        frames_ = static_cast<int>(std::floor(frames + 1e-6));
    }
    int frames() const { return frames_; } ///< after the first row

    Place place(int k) const {
        const double t = time(0) + k * timing_.frame_seconds;
        std::size_t low = 0, high = table_.row_count() - 1;
        while (high - low > 1) {
            const std::size_t middle = (low + high) / 2;
            (time(middle) <= t ? low : high) = middle;
        }
        if (low == high)
            return {low, 0};
        return {low, std::clamp((t - time(low)) / (time(high) - time(low)), 0.0, 1.0)};
    }

private:
    double time(std::size_t row) const { return table_.value(row, static_cast<std::size_t>(column_)); }
    const StorageTable& table_;
    TableTiming timing_;
    int column_ = -1, frames_ = 0;
};

double checked(const StorageTable& table, std::size_t row, std::size_t column) {
    const double value = table.value(row, column);
    if (!std::isfinite(value))
        throw_error(table.file + ", line " + std::to_string(table.lines[row]),
                    "'" + table.columns[column] + "' is not a finite number", "a number");
    return value;
}

} // namespace

int frame_count(const StorageTable& table, const TableTiming& timing) {
    return TableClock(table, timing).frames() + timing.lead_in;
}

std::vector<AngleKey> column_angles(const StorageTable& table, int column, double factor,
                                    const TableTiming& timing) {
    FASCICLE_ASSERT(column >= 0 && column < static_cast<int>(table.columns.size()));
    const TableClock clock(table, timing);
    const auto c = static_cast<std::size_t>(column);
    const double zero = timing.lead_in > 0 ? 0.0 : checked(table, 0, c);
    std::vector<AngleKey> angles;
    if (timing.lead_in > 0)
        angles.push_back({0, 0});
    for (int k = 0; k <= clock.frames(); ++k) {
        const Place at = clock.place(k);
        double value = checked(table, at.row, c);
        if (at.share > 0)
            value += at.share * (checked(table, at.row + 1, c) - value);
        angles.push_back({double(timing.lead_in + k), factor * (value - zero)});
    }
    return angles;
}

Timeline model_timeline(const StorageTable& table, const LineMuscles& lines,
                        const std::vector<std::string>& bone_of_body, int fixed_body, const Scene& scene,
                        const TableTiming& timing, std::vector<std::string>& notes) {
    const Skeleton& skeleton = lines.model->skeleton;
    FASCICLE_ASSERT(bone_of_body.size() == skeleton.bodies.size() && fixed_body >= 0 &&
                    fixed_body < static_cast<int>(skeleton.bodies.size()));
    const TableClock clock(table, timing);
    const CoordinateColumns columns = match_coordinates(table, skeleton);
    notes.insert(notes.end(), columns.notes.begin(), columns.notes.end());
    const auto fixed = static_cast<std::size_t>(fixed_body);
    const double units = scene_units_per_metre(scene.unit);
    const Pose base = lines.rest[fixed];

    std::vector<int> body_of(scene.bones.size(), -1);
    for (std::size_t b = 0; b < bone_of_body.size(); ++b)
        if (const int bone = bone_of_body[b].empty() ? -1 : scene.bone_index(bone_of_body[b]);
            bone >= 0 && b != fixed && bone_of_body[b] != bone_of_body[fixed] &&
            body_of[static_cast<std::size_t>(bone)] < 0)
            body_of[static_cast<std::size_t>(bone)] = static_cast<int>(b);

    std::vector<double> q, next;
    const auto poses_at = [&](const std::vector<double>& values, std::vector<Pose>& poses) {
        std::vector<double> coupled = values;
        apply_couplers(skeleton, coupled);
        place_bodies(skeleton, coupled, poses);
        const Pose ground = poses[fixed].inverse();
        for (Pose& pose : poses)
            pose = ground.after(pose);
    };
    const auto values_at = [&](int k) {
        const Place at = clock.place(k);
        coordinate_values(table, columns, at.row, skeleton, q);
        if (at.share > 0) {
            coordinate_values(table, columns, at.row + 1, skeleton, next);
            for (std::size_t i = 0; i < q.size(); ++i)
                q[i] += at.share * (next[i] - q[i]);
        }
    };
    std::vector<Pose> rest, now;
    if (timing.lead_in > 0) {
        poses_at(lines.rest_values, rest);
    } else {
        values_at(0);
        poses_at(q, rest);
    }
    Timeline timeline;
    timeline.last_frame = timing.lead_in + clock.frames();
    timeline.bone_tracks.resize(scene.bones.size());
    for (std::size_t bone = 0; bone < body_of.size(); ++bone)
        if (body_of[bone] >= 0)
            timeline.bone_tracks[bone].keys.push_back({0, Pose{}});
    for (int k = timing.lead_in > 0 ? 0 : 1; k <= clock.frames(); ++k) {
        values_at(k);
        poses_at(q, now);
        for (std::size_t bone = 0; bone < body_of.size(); ++bone) {
            if (body_of[bone] < 0)
                continue;
            const auto b = static_cast<std::size_t>(body_of[bone]);
            Pose pose = base.after(now[b].after(rest[b].inverse().after(base.inverse())));
            pose.translation *= units;
            std::vector<PoseKey>& keys = timeline.bone_tracks[bone].keys;
            const PoseKey key{double(timing.lead_in + k), pose};
            if (check_step(keys.back(), key) != KeyStep::good)
                throw_error(table.file,
                            "bone '" + scene.bones[bone].name +
                                "' would turn by half a turn or more before frame " + number_text(key.frame),
                            "more frames");
            keys.push_back(key);
        }
    }
    std::string moving;
    for (std::size_t bone = 0; bone < body_of.size(); ++bone)
        if (timeline.moves(static_cast<int>(bone)))
            moving += (moving.empty() ? "" : ", ") + scene.bones[bone].name;
    if (moving.empty())
        throw_error(table.file, "no bone moves: no body that moves in it belongs to a bone",
                    "bones given to the model's bodies");
    notes.push_back("moves " + moving);
    return timeline;
}

} // namespace fascicle
