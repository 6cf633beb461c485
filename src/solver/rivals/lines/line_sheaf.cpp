#include "solver/rivals/lines/line_sheaf.hpp"

#include "fascicle/base/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::solver {

namespace {

constexpr double longest_step_mm = 3.0; ///< below the depth at which a distance grid still knows the way out
constexpr int most_steps = 100;
/// A string is tight to this share of its mean segment. How far it is off is up to 300 times as much, for a long free string: about
/// 0.01 mm.
constexpr double tolerance_share = 1e-5;
constexpr double known_share =
    0.75; ///< of a grid's saturation, up to which it tells the distance and the way out
constexpr double same_motion = 1e-11; ///< share of the distances at hand

std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

void tighten(MuscleLine& line, const Points& before, std::span<const ContactSolid> solids,
             const ContactSettings& contact) {
    StringSettings settings;
    settings.tolerance = tolerance_share * length_of(line.nodes) / double(line_nodes - 1);
    tighten(line.nodes, {line.held, line.clearance}, before, solids, contact, settings);
}

} // namespace

LineSheaf::LineSheaf(const SoftBodyProblem& problem, const MeshTopology& topology, const EndShares& shares,
                     const ContactSettings& contact, int count, int via)
    : contact_(contact), longest_step_(longest_step_mm / problem.unit_mm),
      lines_(make_lines(problem, topology, shares, count, via)), poses_(problem.solids.size()) {
    contact_.friction = 0.0;
    for (const SolidBody& solid : problem.solids)
        step_.push_back({solid.grid.get(), Pose{}, Pose{}});
    for (MuscleLine& line : lines_) {
        for (std::size_t k = 1; k + 1 < line_nodes && !step_.empty(); ++k)
            resolve_contact(line.nodes[k], line.rest[k], step_, contact_);
        tighten(line, line.rest, step_, contact_);
        line.rest = line.nodes;
        find_clearance(line);
    }
}

/// Muscle lies between a line and a bone beneath it, so a line wraps over bones at the distance that it has at rest, as far as the
/// distance grids tell.
void LineSheaf::find_clearance(MuscleLine& line) const {
    line.clearance.assign(line_nodes, contact_.offset);
    for (std::size_t k = 1; k + 1 < line_nodes; ++k)
        for (std::size_t b = 0; b < step_.size() && line.solid[k] < 0; ++b) {
            const double far = known_share * step_[b].grid->saturation();
            const double here = std::min(far, step_[b].grid->value(line.rest[k]));
            line.clearance[k] = b == 0 ? here : std::min(line.clearance[k], here);
        }
    for (double& clearance : line.clearance)
        clearance = std::max(clearance, contact_.offset);
}

int LineSheaf::steps_for(std::span<const ContactSolid> now) const {
    double farthest = 0;
    for (const MuscleLine& line : lines_)
        for (const Vec3& q : line.nodes) {
            const auto moved = [&](int solid) {
                return now[at(solid)].now.apply(poses_[at(solid)].apply_inverse(q));
            };
            const Vec3 with_from = moved(line.from);
            for (std::size_t b = 0; b < now.size(); ++b)
                farthest = std::max(farthest, (moved(static_cast<int>(b)) - with_from).norm());
        }
    if (!std::isfinite(farthest))
        return 1;
    return static_cast<int>(std::clamp(std::ceil(farthest / longest_step_), 1.0, double(most_steps)));
}

void LineSheaf::move(std::span<const ContactSolid> now, int threads) {
    if (lines_.empty())
        return;
    std::vector<Pose>& last = poses_;
    double scale = 0, apart = 0; // how far the solids' motions differ, where the lines are
    for (const MuscleLine& line : lines_)
        for (const Vec3& q : {line.nodes.front(), line.nodes[line_nodes / 2], line.nodes.back()}) {
            const Vec3 first = now[0].now.apply(last[0].apply_inverse(q));
            scale = std::max({scale, q.norm(), first.norm(), now[0].now.translation.norm()});
            for (std::size_t b = 1; b < now.size(); ++b)
                apart = std::max(apart, (now[b].now.apply(last[b].apply_inverse(q)) - first).norm());
        }
    for (std::size_t b = 1; b < now.size(); ++b)
        apart = std::max(apart, scale * (now[b].now.rotation * last[b].rotation.transpose() -
                                         now[0].now.rotation * last[0].rotation.transpose())
                                            .norm());
    if (apart <= same_motion * scale) {
        const Pose motion = now[0].now.after(last[0].inverse());
        for (MuscleLine& line : lines_)
            for (Vec3& q : line.nodes)
                q = motion.is_identity() ? q : motion.apply(q);
    } else {
        const int steps = steps_for(now);
        const std::vector<Pose> start = last;
        for (int k = 0; k < steps; ++k) {
            for (std::size_t b = 0; b < now.size(); ++b) {
                step_[b] = now[b];
                step_[b].before = screw_between(start[b], now[b].now, double(k) / steps);
                step_[b].now = screw_between(start[b], now[b].now, double(k + 1) / steps);
            }
            step(step_, threads);
        }
    }
    for (std::size_t b = 0; b < now.size(); ++b)
        last[b] = now[b].now;
}

void LineSheaf::step(std::span<const ContactSolid> solids, int threads) {
    parallel_for(threads, lines_.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) {
            MuscleLine& line = lines_[n];
            const Points before = line.nodes;
            for (std::size_t k = 0; k < line_nodes; ++k) {
                if (line.solid[k] >= 0) {
                    line.nodes[k] = solids[at(line.solid[k])].now.apply(line.rest[k]);
                    if (k > 0 && k + 1 < line_nodes)
                        resolve_contact(line.nodes[k], before[k], solids, contact_);
                    continue;
                }
                const double share = double(k) / double(line_nodes - 1);
                const auto carried = [&](int solid) {
                    return solids[at(solid)].now.apply(solids[at(solid)].before.apply_inverse(before[k]));
                };
                line.nodes[k] = (1.0 - share) * carried(line.from) + share * carried(line.to);
            }
            tighten(line, before, solids, contact_);
        }
    });
}

std::size_t LineSheaf::bytes() const {
    std::size_t sum = bytes_of(lines_, poses_, step_);
    for (const MuscleLine& line : lines_)
        sum += bytes_of(line.nodes, line.rest, line.solid, line.held, line.clearance);
    return sum;
}

} // namespace fascicle::solver
