#include "solver/fast/fast_contact.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/bytes_of.hpp"
#include "fascicle/geometry/distance_grid.hpp"
#include "solver/contact/contact_setup.hpp"
#include "solver/contact/grid_slope.hpp"
#include "solver/contact/plane_contact.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace fascicle::solver::fast {

namespace {

constexpr std::size_t line = 16; // floats in a cache line

/// m and t of m x + t as a row-major 3 x 4 matrix of floats.
void set_affine(float (&out)[12], const Mat3& m, const Vec3& t) {
    for (Eigen::Index r = 0; r < 3; ++r) {
        for (Eigen::Index c = 0; c < 3; ++c)
            out[4 * r + c] = static_cast<float>(m(r, c));
        out[4 * r + 3] = static_cast<float>(t[r]);
    }
}

} // namespace

/// Records of the kernel as the guards see them: points are numbers of records, places in the caller's frame.
class FastContact::Records final : public GuardedPoints {
public:
    Records(FastContact& contact, const VertexArrays& v, std::span<const ContactSolid> solids)
        : contact_(contact), v_(v), solids_(solids) {}

    Vec3 now(int point) const override {
        const float* r = v_.records + 4 * static_cast<std::size_t>(point);
        return contact_.plan_.origin +
               Vec3(static_cast<double>(r[0]), static_cast<double>(r[1]), static_cast<double>(r[2]));
    }
    Vec3 at_frame_start(int point) const override {
        const float* p = contact_.frame_start_.data() + 3 * static_cast<std::size_t>(point);
        return contact_.plan_.origin +
               Vec3(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]));
    }
    Vec3 before(int point) const override {
        const auto& start = group(point).start;
        const std::size_t i = lane(point);
        return contact_.plan_.origin + Vec3(static_cast<double>(start[0][i]),
                                            static_cast<double>(start[1][i]),
                                            static_cast<double>(start[2][i]));
    }
    bool is_free(int point) const override {
        return v_.records[4 * static_cast<std::size_t>(point) + 3] > 0.0f;
    }
    Vec3 way(int point) const override {
        const auto& carried = group(point).carried;
        const float* r = v_.records + 4 * static_cast<std::size_t>(point);
        const std::size_t i = lane(point);
        return Vec3(static_cast<double>(r[0] - carried[0][i]), static_cast<double>(r[1] - carried[1][i]),
                    static_cast<double>(r[2] - carried[2][i]));
    }
    void set_way(int point, const Vec3& way) override {
        const float* r = v_.records + 4 * static_cast<std::size_t>(point);
        for (std::size_t k = 0; k < 3; ++k)
            group(point).carried[k][lane(point)] =
                r[k] - static_cast<float>(way[static_cast<Eigen::Index>(k)]);
    }
    void put(int point, const Vec3& x, const Vec3& normal, bool stopped) override {
        const Vec3 relative = x - contact_.plan_.origin;
        const auto moved = static_cast<float>((x - now(point)).norm());
        float* travel =
            contact_.travel_.data() + contact_.stride_ * contact_.chunk_of(static_cast<std::size_t>(point));
        for (std::size_t b = 0; b < solids_.size(); ++b)
            travel[b] += moved;
        VertexGroup& own = group(point);
        const std::size_t i = lane(point);
        const bool touches = !normal.isZero(0.0);
        if (touches && own.touched == 0) {
            for (auto& row : own.normal)
                std::fill(std::begin(row), std::end(row), 0.0f);
            own.touched = 1;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const auto c = static_cast<Eigen::Index>(k);
            v_.records[4 * static_cast<std::size_t>(point) + k] = static_cast<float>(relative[c]);
            if (touches)
                own.normal[k][i] = static_cast<float>(normal[c]);
            if (stopped) // measured from here, the velocity is zero
                own.carried[k][i] = static_cast<float>(relative[c]);
        }
        contact_.refresh_slack(v_, static_cast<std::size_t>(point), solids_);
    }

private:
    VertexGroup& group(int point) const { return v_.groups[static_cast<std::size_t>(point) / packet]; }
    static std::size_t lane(int point) { return static_cast<std::size_t>(point) % packet; }

    FastContact& contact_;
    const VertexArrays& v_;
    std::span<const ContactSolid> solids_;
};

FastContact::FastContact(const SoftBodyProblem& problem, const MeshTopology& topology, const Plan& plan,
                         const Kernels& kernels, int threads)
    : plan_(plan), kernels_(kernels), bodies_(problem.solids),
      substeps_(passes_per_frame(problem.parameters)), settings_(contact_settings(problem)) {
    for (const SolidBody& body : bodies_) {
        FASCICLE_ASSERT(body.grid != nullptr);
        const DistanceGrid& grid = *body.grid;
        SolidStep solid{};
        solid.values = grid.values().data();
        for (std::size_t k = 0; k < 3; ++k)
            solid.cells[k] = grid.values().empty() ? 0 : grid.nodes()[k] - 1;
        solid.step_y = grid.nodes()[0];
        solid.step_z = grid.nodes()[0] * grid.nodes()[1];
        solid.saturation = static_cast<float>(grid.saturation());
        solid.per_slope = static_cast<float>(1.0 / largest_slope(grid, problem.threads));
        solids_.push_back(solid);
    }
    solid_steps_.resize(solids_.size() * static_cast<std::size_t>(substeps_));
    contact_solids_.resize(solid_steps_.size());
    stride_ = (solids_.size() + line - 1) / line * line;
    step_travel_.assign(plan.chunks.size() * stride_, 0.0f);
    travel_ = step_travel_;
    for (std::size_t c = 0; c < plan.chunks.size(); ++c)
        chunk_of_group_.resize(plan.chunks[c].end, static_cast<std::uint16_t>(c));
    found_.assign(static_cast<std::size_t>(threads) * line, 0);
    if (!solids_.empty())
        make_samples(problem, topology);
}

/// Samples by equal weights and limits, those of equal ones by where their corners lie.
void FastContact::make_samples(const SoftBodyProblem& problem, const MeshTopology& topology) {
    std::vector<ContactSample> samples = contact_samples_of(problem, topology);
    for (ContactSample& sample : samples)
        for (int& corner : sample.corner)
            corner = plan_.record_of_vertex[static_cast<std::size_t>(corner)];
    const auto low = [](const ContactSample& s) {
        return *std::min_element(s.corner.begin(), s.corner.end());
    };
    const auto key = [&](const ContactSample& s) {
        return std::tuple(s.weight, s.near_solid, s.near_solid < 0 ? 0.0F : s.limit, low(s));
    };
    std::stable_sort(samples.begin(), samples.end(),
                     [&](const ContactSample& a, const ContactSample& b) { return key(a) < key(b); });
    for (std::size_t i = 0; i < samples.size();) {
        SamplePacket next{};
        const ContactSample& first = samples[i];
        std::copy(first.weight.begin(), first.weight.end(), std::begin(next.weight));
        next.limit = first.limit;
        next.near_solid = first.near_solid;
        // Samples with limits of their own come by limit, not by place: the corners of some may lie far below.
        std::size_t end = i;
        int base = low(first), highest = 0;
        for (; end < samples.size() && end - i < packet; ++end) {
            const ContactSample& s = samples[end];
            const int least = std::min(base, low(s)),
                      most = std::max(highest, *std::max_element(s.corner.begin(), s.corner.end()));
            if (s.weight != first.weight || s.near_solid != first.near_solid || most - least > 65535)
                break;
            base = least;
            highest = most;
        }
        next.base = static_cast<std::uint32_t>(base);
        next.count = static_cast<std::uint32_t>(end - i);
        next.first_chunk = static_cast<std::uint16_t>(chunk_of(static_cast<std::size_t>(base)));
        next.last_chunk = static_cast<std::uint16_t>(chunk_of(static_cast<std::size_t>(highest)));
        for (std::size_t k = 0; k < packet; ++k) {
            const ContactSample& s = samples[i + (k < next.count ? k : 0)];
            for (std::size_t c = 0; c < 3; ++c)
                next.p[c][k] = static_cast<std::uint16_t>(s.corner[c] - base);
        }
        packets_.push_back(next);
        i = end;
    }
    packets_.shrink_to_fit();
    sample_slack_.assign(packets_.size() * solids_.size(), -1.0f);
    violations_.assign(packets_.size(), 0);
    hot_.assign(packets_.size(), 0);
    if (!packets_.empty())
        frame_start_.assign(3 * plan_.records(), 0.0f);
    guard_ = SampleGuard(plan_.records());
}

/// Relative to the plan's origin o: a point is x + o.
void FastContact::set_solids(std::span<const Pose> from, std::span<const Pose> to) {
    const Vec3& o = plan_.origin;
    frame_solids_.clear();
    for (std::size_t b = 0; b < solids_.size(); ++b)
        frame_solids_.push_back(
            {bodies_[b].grid.get(), to[b], from[b], 1.0 / static_cast<double>(solids_[b].per_slope)});
    for (std::size_t b = 0; b < solids_.size(); ++b) {
        const DistanceGrid& grid = *bodies_[b].grid;
        const double per_h = 1.0 / grid.spacing();
        Pose before = screw_between(from[b], to[b], 0.0);
        for (int k = 0; k < substeps_; ++k) {
            const std::size_t at = static_cast<std::size_t>(k) * solids_.size() + b;
            SolidStep& s = solid_steps_[at];
            s = solids_[b];
            const Pose now = screw_between(from[b], to[b], double(k + 1) / substeps_);
            const Pose inverse = now.inverse();
            set_affine(s.to_grid, per_h * inverse.rotation, per_h * (inverse.apply(o) - grid.low()));
            for (Eigen::Index i = 0; i < 3; ++i)
                for (Eigen::Index j = 0; j < 3; ++j)
                    s.turn[3 * i + j] = static_cast<float>(per_h * now.rotation(i, j));
            const Pose step = now.after(before.inverse());
            set_affine(s.carry, step.rotation - Mat3::Identity(), step.apply(o) - o);
            set_affine(s.place, now.rotation, now.apply(o) - o);
            s.moves = from[b].rotation != to[b].rotation || from[b].translation != to[b].translation;
            contact_solids_[at] = {&grid, now, before, 1.0 / static_cast<double>(s.per_slope)};
            before = now;
        }
    }
}

void FastContact::set_slack(const VertexArrays& v) {
    std::vector<ContactSolid> solids = frame_solids_;
    for (ContactSolid& solid : solids)
        solid.now = solid.before;
    for (const int record : plan_.record_of_vertex)
        refresh_slack(v, static_cast<std::size_t>(record), solids);
}

void FastContact::refresh_slack(const VertexArrays& v, std::size_t record,
                                std::span<const ContactSolid> solids) {
    const float* r = v.records + 4 * record;
    const Vec3 x =
        plan_.origin + Vec3(static_cast<double>(r[0]), static_cast<double>(r[1]), static_cast<double>(r[2]));
    for (std::size_t b = 0; b < solids.size(); ++b) {
        const double room = solids[b].grid->value(solids[b].now.apply_inverse(x)) - settings_.offset;
        // A little less: the lanes count in floats.
        v.slack[packet * (record / packet * solids.size() + b) + record % packet] =
            static_cast<float>(room / solids[b].slope - 1e-3 * settings_.offset);
    }
}

void FastContact::begin_frame(const VertexArrays& v, const GroupRange& range) {
    if (frame_start_.empty())
        return;
    for (std::size_t r = packet * range.begin; r < packet * range.end; ++r)
        std::copy_n(v.records + 4 * r, 3, frame_start_.data() + 3 * r);
}

void FastContact::guard(const VertexArrays& v, const GroupRange& range, int substep, ContactSums& sums) {
    const std::span<const ContactSolid> solids = solids_at(substep);
    Records records(*this, v, solids);
    GuardCounts counts;
    const std::size_t chunk = chunk_of_group_[range.begin];
    float* total = travel_.data() + chunk * stride_;
    for (std::size_t b = 0; b < solids.size(); ++b)
        total[b] += step_travel(chunk)[b];
    for (std::size_t g = range.begin; g < range.end; ++g)
        for (std::uint32_t left = v.groups[g].suspects; left != 0; left &= left - 1) {
            const auto record = packet * g + static_cast<std::size_t>(__builtin_ctz(left));
            if (!guard_point(records, static_cast<int>(record), solids, false, settings_, counts))
                refresh_slack(v, record, solids);
        }
    sums.slid += counts.slid;
    sums.ejected += counts.ejected;
    sums.impossible += counts.impossible;
}

void FastContact::set_planes(std::span<const PointPlane> planes) {
    planes_.assign(planes.begin(), planes.end());
    for (PointPlane& plane : planes_)
        plane.vertex = plan_.record_of_vertex[static_cast<std::size_t>(plane.vertex)];
    std::stable_sort(planes_.begin(), planes_.end(),
                     [](const PointPlane& a, const PointPlane& b) { return a.vertex < b.vertex; });
    first_plane_.assign(plan_.chunks.size() + 1, planes_.size());
    for (std::size_t i = planes_.size(); i-- > 0;)
        first_plane_[chunk_of(static_cast<std::size_t>(planes_[i].vertex))] = i;
    for (std::size_t c = plan_.chunks.size(); c-- > 0;)
        first_plane_[c] = std::min(first_plane_[c], first_plane_[c + 1]);
}

void FastContact::hold_planes(const VertexArrays& v, std::size_t chunk, int substep, ContactSums& sums) {
    if (planes_.empty())
        return;
    Records records(*this, v, solids_at(substep));
    GuardCounts counts;
    for (std::size_t i = first_plane_[chunk]; i < first_plane_[chunk + 1]; ++i)
        sums.contacts += hold_to_plane(planes_[i], planes_[i].vertex, substep, substeps_, records,
                                       solids_at(substep), settings_, counts)
                             ? 1
                             : 0;
    sums.slid += counts.slid;
    sums.ejected += counts.ejected;
    sums.impossible += counts.impossible;
}

void FastContact::check_samples(const VertexArrays& v, int thread, int threads, int substep,
                                const StepSettings& settings) {
    const auto share = [&](int t) {
        return packets_.size() * static_cast<std::size_t>(t) / static_cast<std::size_t>(threads);
    };
    const auto look = [&](std::size_t begin, std::size_t end) {
        return kernels_.samples(v.records, packets_.data(), begin, end, steps(substep), settings,
                                travel_.data(), stride_, sample_slack_.data(), violations_.data());
    };
    for (int t = thread; t < static_cast<int>(found_.size() / line); t += threads)
        found_[static_cast<std::size_t>(t) * line] = 0;
    std::size_t& found = found_[static_cast<std::size_t>(thread) * line];
    if (is_last(substep)) {
        found = look(share(thread), share(thread + 1));
        return;
    }
    for (std::size_t n = share(thread); n < share(thread + 1); ++n) {
        violations_[n] = 0;
        if (hot_[n] == 0)
            continue;
        --hot_[n];
        // What it may still travel is not counted on here, nor used up.
        std::fill_n(sample_slack_.data() + n * solids_.size(), solids_.size(), -1.0f);
        found += look(n, n + 1);
        std::fill_n(sample_slack_.data() + n * solids_.size(), solids_.size(), -1.0f);
    }
}

bool FastContact::samples_violated() const {
    for (std::size_t t = 0; t < found_.size(); t += line)
        if (found_[t] != 0)
            return true;
    return false;
}

ContactSample FastContact::sample_of(std::size_t packet_number, std::size_t lane) const {
    const SamplePacket& p = packets_[packet_number];
    ContactSample sample;
    for (std::size_t k = 0; k < 3; ++k) {
        sample.corner[k] = static_cast<int>(p.base + p.p[k][lane]);
        sample.weight[k] = p.weight[k];
    }
    sample.limit = p.limit;
    sample.near_solid = p.near_solid;
    return sample;
}

void FastContact::resolve_samples(const VertexArrays& v, int substep, int round) {
    const std::span<const ContactSolid> solids = solids_at(substep);
    Records records(*this, v, solids);
    if (round == 0)
        guard_.begin(frame_solids_);
    if (is_last(substep)) // from here on, of what the rounds move
        std::fill(travel_.begin(), travel_.end(), 0.0f);
    moved_ = false;
    for (std::size_t n = 0; n < packets_.size(); ++n) {
        if (violations_[n] == 0)
            continue;
        hot_[n] = SampleGuard::hot_substeps;
        for (std::uint32_t left = violations_[n]; left != 0; left &= left - 1)
            moved_ |= guard_.resolve(sample_of(n, static_cast<std::size_t>(__builtin_ctz(left))), round,
                                     records, solids, settings_, counts_);
    }
}

void FastContact::end_frame(bool settled) {
    std::fill(travel_.begin(), travel_.end(), 0.0f);
    if (!settled)
        std::fill(sample_slack_.begin(), sample_slack_.end(), -1.0f);
}

std::size_t FastContact::bytes() const {
    return bytes_of(step_travel_, travel_, chunk_of_group_, packets_, sample_slack_, violations_, hot_,
                    frame_start_) +
           guard_.bytes();
}

} // namespace fascicle::solver::fast
