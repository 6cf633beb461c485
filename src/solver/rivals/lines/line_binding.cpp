#include "solver/rivals/lines/line_binding.hpp"

#include "fascicle/base/parallel.hpp"
#include "solver/rivals/lines/middle_line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fascicle::solver {

namespace {

constexpr std::size_t most_stations = 32; ///< of a vertex
constexpr double near_attachment = 0.3;   ///< share of the other solids up to which an attachment is felt
constexpr int tangent_smoothings = 2;

std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

/// exp(share log(rotation)).
Mat3 part_of(const Mat3& rotation, double share) {
    const Eigen::AngleAxisd turn(rotation);
    if (turn.angle() == 0.0)
        return Mat3::Identity();
    return Eigen::AngleAxisd(share * turn.angle(), turn.axis()).toRotationMatrix();
}

/// The smallest turn from one unit vector to another, by a share of its angle; none where either is zero or they are opposite.
Mat3 turn_between(const Vec3& from, const Vec3& to, double share) {
    const Vec3 axis = from.cross(to);
    const double sine = axis.norm();
    if (!(sine > 0.0))
        return Mat3::Identity();
    return Eigen::AngleAxisd(share * std::atan2(sine, from.dot(to)), axis / sine).toRotationMatrix();
}

/// How wide a vertex's neighbourhood on the lines is: more than the steps between stations, and enough to reach the next line.
double reach_of(const std::vector<Points>& places) {
    double step = 0, apart = 0;
    for (const Points& line : places) {
        step += length_of(line) / double(line_stations - 1) / double(places.size());
        double nearest = std::numeric_limits<double>::infinity();
        for (const Points& other : places)
            if (&other != &line)
                nearest = std::min(nearest, (line[line_stations / 2] - other[line_stations / 2]).norm());
        if (std::isfinite(nearest))
            apart += nearest / double(places.size());
    }
    return std::max(1.5 * step, 0.5 * apart);
}

} // namespace

void find_stations(const Points& nodes, Points& places, Points& tangents) {
    const MiddleLine line = with_lengths(nodes);
    places.resize(line_stations);
    tangents.resize(line_stations);
    for (std::size_t k = 0; k < line_stations; ++k)
        places[k] = line.at(double(k) / double(line_stations - 1));
    for (std::size_t k = 0; k < line_stations; ++k)
        tangents[k] = places[std::min(k + 1, line_stations - 1)] - places[k > 0 ? k - 1 : 0];
    for (int round = 0; round < tangent_smoothings; ++round) {
        Vec3 last = tangents[0];
        for (std::size_t k = 1; k + 1 < line_stations; ++k) {
            const Vec3 here = tangents[k];
            tangents[k] = 0.25 * last + 0.5 * here + 0.25 * tangents[k + 1];
            last = here;
        }
    }
    for (Vec3& t : tangents)
        t = t.norm() > 0.0 ? t.normalized() : Vec3(Vec3::Zero());
}

LineBinding::LineBinding(const SoftBodyProblem& problem, const MeshTopology& topology,
                         const EndShares& shares, const std::vector<MuscleLine>& lines)
    : rest_(problem.surface->positions), rest_places_(lines.size()), rest_tangents_(lines.size()),
      frames_(lines.size() * line_stations) {
    std::vector<char> has_lines(at(topology.component_count()), 0);
    for (std::size_t n = 0; n < lines.size(); ++n) {
        find_stations(lines[n].rest, rest_places_[n], rest_tangents_[n]);
        has_lines[at(lines[n].part)] = 1;
    }
    const double reach = lines.empty() ? 0.0 : reach_of(rest_places_);
    const double per_reach = reach > 0.0 ? 0.5 / (reach * reach) : 0.0;

    std::vector<std::vector<Station>> found(rest_.size());
    parallel_for(problem.threads, rest_.size(), 256, [&](std::size_t begin, std::size_t end) {
        std::vector<std::pair<double, int>> near; // squared distance, station
        for (std::size_t v = begin; v < end; ++v) {
            const int part = topology.vertex_component(static_cast<int>(v));
            if (part < 0 || problem.body_of_vertex[v] >= 0)
                continue;
            near.clear();
            for (std::size_t n = 0; n < lines.size(); ++n)
                if (has_lines[at(part)] == 0 || lines[n].part == part)
                    for (std::size_t k = 0; k < line_stations; ++k)
                        near.emplace_back((rest_[v] - rest_places_[n][k]).squaredNorm(),
                                          static_cast<int>(n * line_stations + k));
            if (near.empty())
                continue;
            const std::size_t take = std::min(near.size(), most_stations);
            std::partial_sort(near.begin(),
                              near.begin() + static_cast<std::ptrdiff_t>(std::min(take + 1, near.size())),
                              near.end());
            const auto bell = [&](std::size_t k) {
                return std::exp(per_reach * (near[0].first - near[k].first));
            };
            const double cut = take < near.size()
                                   ? bell(take)
                                   : 0.0; // weights fall to 0 where stations are no longer counted
            double sum = 0;
            for (std::size_t k = 0; k < take; ++k)
                sum += bell(k) - cut;
            for (std::size_t k = 0; k < take; ++k)
                if (const double w = sum > 0.0 ? (bell(k) - cut) / sum : 1.0 / double(take); w > 0.0)
                    found[v].push_back({near[k].second, w});
        }
    });
    for (std::size_t v = 0; v < rest_.size(); ++v) {
        double held = 0;
        for (std::size_t s = 0; s < shares.solids.size(); ++s) {
            const double near = 1.0 - (1.0 - shares.of(v, s)) / near_attachment;
            if (near <= 0.0)
                continue;
            holds_.push_back({shares.solids[s], near * near});
            held += near * near;
        }
        hold_starts_.push_back(static_cast<int>(holds_.size()));
        for (Station& station : found[v]) {
            station.weight *= std::max(0.0, 1.0 - held);
            if (station.weight > 0.0)
                stations_.push_back(station);
        }
        starts_.push_back(static_cast<int>(stations_.size()));
    }
}

void LineBinding::find_frames(const std::vector<MuscleLine>& lines, std::span<const ContactSolid> solids) {
    for (std::size_t n = 0; n < lines.size(); ++n) {
        const Mat3& from = solids[at(lines[n].from)].now.rotation;
        const Mat3& to = solids[at(lines[n].to)].now.rotation;
        const Mat3 between = from == to ? Mat3(Mat3::Identity()) : Mat3(from.transpose() * to);
        find_stations(lines[n].nodes, places_, tangents_);
        for (std::size_t k = 0; k < line_stations; ++k) {
            const double share = double(k) / double(line_stations - 1);
            const Mat3 carried = from * part_of(between, share);
            // With the solid at an end, with the line inside.
            const double along = 1.0 - std::pow(2.0 * share - 1.0, 4);
            Pose& frame = frames_[n * line_stations + k];
            frame.rotation = turn_between(carried * rest_tangents_[n][k], tangents_[k], along) * carried;
            frame.translation = places_[k] - frame.rotation * rest_places_[n][k];
        }
    }
}

void LineBinding::place(const std::vector<MuscleLine>& lines, std::span<const ContactSolid> solids,
                        int threads, const std::vector<double>& free, Points& x) {
    find_frames(lines, solids);
    parallel_for(threads, rest_.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
            if (free[v] == 0.0 || (starts_[v] == starts_[v + 1] && hold_starts_[v] == hold_starts_[v + 1]))
                continue;
            Vec3 shift = Vec3::Zero();
            for (int k = starts_[v]; k < starts_[v + 1]; ++k)
                shift += stations_[at(k)].weight *
                         (frames_[at(stations_[at(k)].index)].apply(rest_[v]) - rest_[v]);
            for (int k = hold_starts_[v]; k < hold_starts_[v + 1]; ++k)
                shift +=
                    holds_[at(k)].share * (solids[at(holds_[at(k)].solid)].now.apply(rest_[v]) - rest_[v]);
            x[v] = rest_[v] + shift;
        }
    });
}

std::size_t LineBinding::bytes() const {
    std::size_t sum = bytes_of(rest_, starts_, hold_starts_, stations_, holds_, frames_, places_, tangents_,
                               rest_places_, rest_tangents_);
    for (std::size_t n = 0; n < rest_places_.size(); ++n)
        sum += bytes_of(rest_places_[n], rest_tangents_[n]);
    return sum;
}

} // namespace fascicle::solver
