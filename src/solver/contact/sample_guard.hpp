#pragma once
// Keeps the contact samples of a surface out of solids: a guarantee, for a sample that starts a frame outside, as long as its
// corners are not held by another solid. First its free corners are pushed along the solid's gradient, which is where a face
// should lie; what is still inside after some rounds rides: its corners go where the solid has taken them since the frame
// began, so that the sample is where it was as the solid sees it. Riding can bring other samples of those corners in, which then ride too, so the rounds end.

#include "fascicle/solver/soft_body_solver.hpp"
#include "solver/contact/contact_samples.hpp"
#include "solver/contact/swept_clamp.hpp"

#include <cstdint>

namespace fascicle::solver {

/// The points of a solver, as the guard sees and moves them.
class GuardedPoints {
public:
    virtual ~GuardedPoints() = default;
    virtual Vec3 now(int point) const = 0;
    virtual Vec3 before(int point) const = 0; ///< at the start of the substep
    virtual Vec3 at_frame_start(int point) const = 0;
    virtual bool is_free(int point) const = 0;
    /// How far its velocity takes it in a substep, and a new value of that.
    virtual Vec3 way(int point) const = 0;
    virtual void set_way(int point, const Vec3& way) = 0;
    /// normal: of the solid that pushed it, unit, or zero. stopped: it moves on without a velocity of its own.
    virtual void put(int point, const Vec3& x, const Vec3& normal, bool stopped) = 0;
};

struct GuardCounts {
    std::int64_t slid = 0;       ///< points stopped at a solid by the hard bound
    std::int64_t ejected = 0;    ///< points put outside
    std::int64_t impossible = 0; ///< points for which there is no place outside of all solids
    std::int64_t pushed = 0;     ///< samples pushed out
    std::int64_t rode = 0;       ///< points that rode with a solid for the sake of a sample
    std::int64_t held = 0;       ///< samples that stayed inside because a corner is held or there is no place
};

/// Holds one point to the hard bound; counts what happened. Whether it was moved. whole_frame: solids and way are those of the whole
/// frame, else of the substep.
bool guard_point(GuardedPoints& points, int point, std::span<const ContactSolid> solids, bool whole_frame,
                 const ContactSettings& settings, GuardCounts& counts);

/// Puts the sums of both, counted since the start, into the report.
void set_guard_counts(StepReport& report, const GuardCounts& vertices, const GuardCounts& samples);

class SampleGuard {
public:
    static constexpr int push_rounds = 3;
    static constexpr int most_rounds = 24;
    /// A sample that was too near is looked at in every substep for so many: where a ridge lies under a face it will be again.
    static constexpr std::uint8_t hot_substeps = 30;

    SampleGuard() = default;
    explicit SampleGuard(std::size_t point_count) : rides_(point_count, -1) {}

    /// Before round 0. from_frame_start: the solids from the beginning to the end of the frame, for riding.
    void begin(std::span<const ContactSolid> from_frame_start);
    /// Round 0, 1, ... at the end of a frame, or round 0 of a substep before: deals with one sample that may violate its limits, after a look whether it does. Whether anything
    /// was moved.
    bool resolve(const ContactSample& sample, int round, GuardedPoints& points,
                 std::span<const ContactSolid> solids, const ContactSettings& settings, GuardCounts& counts);
    std::size_t bytes() const { return bytes_of(rides_, riders_); }

private:
    bool push(const ContactSample& sample, std::size_t solid, double depth, GuardedPoints& points,
              std::span<const ContactSolid> solids, const ContactSettings& settings, GuardCounts& counts);
    bool ride(const ContactSample& sample, std::size_t solid, GuardedPoints& points,
              const ContactSettings& settings, GuardCounts& counts);

    std::vector<std::int16_t> rides_; ///< by point: the solid it rides with in this substep, or -1
    std::vector<int> riders_;
    std::span<const ContactSolid> frame_;
};

/// By how much a sample is nearer to a solid than it may be, and to which; the solid is -1 when to none.
struct SampleViolation {
    double value = 0; ///< of the solid's interpolant
    double limit = 0;
    int solid = -1;
};
SampleViolation find_violation(const ContactSample& sample, const Vec3& place,
                               std::span<const ContactSolid> solids, const ContactSettings& settings);

} // namespace fascicle::solver
