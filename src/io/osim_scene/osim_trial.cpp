#include "io/osim_scene/osim_trial.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/base/param_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace fascicle::io {
namespace {

constexpr double most_frames = 100000;
constexpr double most_values = 2e7;
constexpr double even = 0.1;      // of the median step
constexpr double gap = 3;         // times the median step
constexpr double jump_rad = 0.35; // 20 degrees between frames
constexpr double jump_m = 0.1;

std::string short_number(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

class TrialReader {
public:
    TrialReader(const StorageTable& table, ModelMotion& motion, std::vector<std::string>& notes)
        : table_(table), motion_(motion), notes_(notes), skeleton_(motion.model->skeleton) {}

    void read() {
        columns_ = match_coordinates(table_, skeleton_);
        notes_.insert(notes_.end(), columns_.notes.begin(), columns_.notes.end());
        find_part();
        choose_clock();
        std::vector<double> row(coordinates());
        std::vector<std::vector<double>> rows;
        for (int k = 0; k <= frames_; ++k) {
            values_at(k, row);
            apply_couplers(skeleton_, row);
            rows.push_back(row);
        }
        check_unit();
        report_jumps(rows);
        add_lead_in(rows.front());
        for (const std::vector<double>& values : rows)
            motion_.values.insert(motion_.values.end(), values.begin(), values.end());
        find_moving();
    }

private:
    std::size_t coordinates() const { return skeleton_.coordinates.size(); }
    double time(std::size_t row) const { return table_.value(row, static_cast<std::size_t>(time_)); }
    std::string line(std::size_t row) const {
        return table_.file + ", line " + std::to_string(table_.lines[row]);
    }
    bool turns(std::size_t c) const { return skeleton_.coordinates[c].kind == CoordinateKind::rotational; }

    /// Rows first_ to last_ are those of the wanted part.
    void find_part() {
        for (std::size_t c = 0; c < table_.columns.size() && time_ < 0; ++c)
            if (table_.columns[c] == "time" || table_.columns[c] == "Time")
                time_ = static_cast<int>(c);
        if (time_ < 0)
            throw_error(table_.file, "there is no column 'time'", "a column of seconds");
        for (std::size_t r = 0; r < table_.row_count(); ++r)
            if (!std::isfinite(time(r)) || (r > 0 && !(time(r) > time(r - 1))))
                throw_error(line(r), "the time does not ascend", "ascending seconds");
        const double begin = time(0), end = time(table_.row_count() - 1);
        const double from = motion_.reading.from_s.value_or(begin), to = motion_.reading.to_s.value_or(end);
        const double slack = 1e-6 * std::max(1.0, end - begin);
        const std::string there = short_number(begin) + " to " + short_number(end) + " s";
        if (!(from >= begin - slack) || !(to <= end + slack) || !(from <= end) || !(to >= begin))
            throw_error(table_.file,
                        "the trial does not reach from " + short_number(from) + " to " + short_number(to) +
                            " s",
                        "times within " + there);
        first_ = 0;
        while (first_ + 1 < table_.row_count() && time(first_) < from - slack)
            ++first_;
        last_ = table_.row_count() - 1;
        while (last_ > 0 && time(last_) > to + slack)
            --last_;
        if (table_.row_count() < 2 || last_ <= first_)
            throw_error(table_.file,
                        "fewer than two rows from " + short_number(from) + " to " + short_number(to) + " s",
                        "a part of a trial of " + there);
    }

    void choose_clock() {
        std::vector<double> steps;
        for (std::size_t r = first_ + 1; r <= last_; ++r)
            steps.push_back(time(r) - time(r - 1));
        std::vector<double> sorted = steps;
        std::sort(sorted.begin(), sorted.end());
        const double median = sorted[sorted.size() / 2], length = time(last_) - time(first_);
        rows_are_frames_ = motion_.reading.frames == 0 && sorted.front() >= (1 - even) * median &&
                           sorted.back() <= (1 + even) * median;
        frames_ = static_cast<int>(steps.size());
        if (motion_.reading.frames > 0)
            frames_ = motion_.reading.frames;
        else if (!rows_are_frames_) {
            const double wanted = length / median;
            if (!(wanted <= most_frames))
                throw_error(table_.file, "it makes " + short_number(wanted) + " frames",
                            "100000 at most: --trial-frames tells how many");
            frames_ = std::max(1, static_cast<int>(std::lround(wanted)));
            notes_.push_back("the trial's time steps are uneven (" + short_number(sorted.front()) + " to " +
                             short_number(sorted.back()) +
                             " s): frames are even, values between rows linear");
        }
        if (!(frames_ <= most_frames))
            throw_error(table_.file, "it makes " + std::to_string(frames_) + " frames",
                        "100000 at most: --trial-frames tells how many");
        if (static_cast<double>(frames_) * static_cast<double>(coordinates()) > most_values)
            throw_error(table_.file,
                        std::to_string(frames_) + " frames of " + std::to_string(coordinates()) +
                            " coordinates are too many",
                        "20 million values at most: --trial-frames, --from and --to tell of less");
        motion_.first_s = time(first_);
        motion_.frame_s = length / frames_;
        int gaps = 0;
        std::size_t widest = 0;
        for (std::size_t i = 0; i < steps.size(); ++i)
            if (steps[i] > gap * median) {
                widest = gaps == 0 || steps[i] > steps[widest] ? i : widest;
                ++gaps;
            }
        if (gaps > 0)
            notes_.push_back("the trial has " + std::to_string(gaps) + (gaps == 1 ? " gap" : " gaps") +
                             ", the widest of " + short_number(steps[widest]) + " s before line " +
                             std::to_string(table_.lines[first_ + widest + 1]) + ": bridged linearly");
    }

    void values_at(int k, std::vector<double>& row) {
        if (rows_are_frames_)
            return coordinate_values(table_, columns_, first_ + static_cast<std::size_t>(k), skeleton_, row);
        const double t = time(first_) + k * motion_.frame_s;
        while (at_ + 1 < last_ && time(at_ + 1) <= t)
            ++at_;
        at_ = std::max(at_, first_);
        const double share = std::clamp((t - time(at_)) / (time(at_ + 1) - time(at_)), 0.0, 1.0);
        coordinate_values(table_, columns_, at_, skeleton_, row);
        if (share == 0)
            return;
        std::vector<double> next;
        coordinate_values(table_, columns_, at_ + 1, skeleton_, next);
        for (std::size_t c = 0; c < row.size(); ++c)
            row[c] += share * (next[c] - row[c]);
    }

    /// Numbers that are absurd in the unit that the header tells, or lets be assumed.
    void check_unit() {
        double most = 0;
        for (std::size_t c = 0; c < coordinates(); ++c)
            if (columns_.column_of[c] >= 0 && turns(c))
                for (std::size_t r = first_; r <= last_; ++r)
                    most = std::max(
                        most, std::abs(table_.value(r, static_cast<std::size_t>(columns_.column_of[c]))));
        if (!table_.in_degrees && most > 3 * std::numbers::pi)
            notes_.push_back("angles of the trial reach " + short_number(most) +
                             " radians: are they degrees? A line inDegrees=yes in its header says so");
        if (table_.in_degrees && most > 0 && most < 2)
            notes_.push_back("angles of the trial stay within " + short_number(most) +
                             " degrees: are they radians? A line inDegrees=no in its header says so");
    }

    void report_jumps(const std::vector<std::vector<double>>& rows) {
        int count = 0;
        std::string first;
        for (std::size_t k = 1; k < rows.size(); ++k)
            for (std::size_t c = 0; c < coordinates(); ++c) {
                const double step = std::abs(rows[k][c] - rows[k - 1][c]);
                if (step <= (turns(c) ? jump_rad : jump_m))
                    continue;
                if (count++ == 0)
                    first = skeleton_.coordinates[c].name + " by " +
                            short_number(turns(c) ? step * 180 / std::numbers::pi : 1000 * step) +
                            (turns(c) ? " degrees" : " mm") + " at " +
                            short_number(motion_.first_s + static_cast<double>(k) * motion_.frame_s) + " s";
            }
        if (count > 0)
            notes_.push_back("the trial jumps between frames: " + first +
                             (count > 1 ? ", and " + std::to_string(count - 1) + " more" : std::string()));
    }

    void add_lead_in(const std::vector<double>& first) {
        const std::vector<double>& rest = motion_.rest_values;
        // The greatest slope of 3 u^2 - 2 u^3 is 1.5.
        double frames = 0;
        for (std::size_t c = 0; c < coordinates(); ++c)
            frames =
                std::max(frames, 1.5 * std::abs(first[c] - rest[c]) / (turns(c) ? lead_in_rad : lead_in_m));
        const bool scan =
            motion_.mesh_frame == MeshFrame::scan; // its rest is no posture of the model's, quite
        motion_.lead_in =
            frames < 1e-9 && !scan ? 0 : static_cast<int>(std::ceil(std::min(frames, most_frames)));
        if (scan)
            motion_.lead_in = std::max(motion_.lead_in, 1);
        if (motion_.lead_in >= most_frames)
            throw_error(table_.file, "its first row is too far from the model's rest",
                        "angles and places within reach of the default posture");
        motion_.values.clear();
        std::vector<double> row(coordinates());
        for (int k = 0; k < motion_.lead_in; ++k) {
            const double u = double(k) / motion_.lead_in, share = u * u * (3 - 2 * u);
            for (std::size_t c = 0; c < coordinates(); ++c)
                row[c] = rest[c] + share * (first[c] - rest[c]);
            apply_couplers(skeleton_, row);
            motion_.values.insert(motion_.values.end(), row.begin(), row.end());
        }
    }

    void find_moving() {
        motion_.moving.clear();
        for (std::size_t c = 0; c < coordinates(); ++c)
            for (int k = 1; k < motion_.frame_count(); ++k)
                if (std::abs(motion_.at(k)[c] - motion_.at(0)[c]) > 1e-9) {
                    motion_.moving.push_back(static_cast<int>(c));
                    break;
                }
    }

    const StorageTable& table_;
    ModelMotion& motion_;
    std::vector<std::string>& notes_;
    const Skeleton& skeleton_;
    CoordinateColumns columns_;
    int time_ = -1, frames_ = 0;
    std::size_t first_ = 0, last_ = 0, at_ = 0;
    bool rows_are_frames_ = false;
};

} // namespace

void read_trial_frames(const StorageTable& table, ModelMotion& motion, std::vector<std::string>& notes) {
    TrialReader(table, motion, notes).read();
}

} // namespace fascicle::io
