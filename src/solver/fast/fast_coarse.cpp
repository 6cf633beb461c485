#include "solver/fast/fast_coarse.hpp"

#include "fascicle/base/bytes_of.hpp"
#include "solver/coarse/coarse_step.hpp"
#include "solver/edge_constraints.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::solver::fast {

namespace {

float* floats(std::vector<Row>& rows) {
    return reinterpret_cast<float*>(rows.data());
}

double dot(const std::vector<float>& a, const std::vector<float>& b) {
    double total = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        total += static_cast<double>(a[i]) * static_cast<double>(b[i]);
    return total;
}

Vec3 vec(const float* p) {
    return Vec3(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]));
}

} // namespace

FastCoarse::FastCoarse(const SoftBodyProblem& problem, const MeshTopology& topology, CoarseMatrix matrix,
                       const Plan& plan, const Kernels& kernels)
    : plan_(plan), kernels_(kernels), matrix_(std::move(matrix)),
      hinges_(plan.rest, topology.dihedrals(), problem.parameters.get("solver.bending")),
      edges_(make_edge_constraints(problem, plan.rest, topology)) {
    if (empty())
        return;
    const double h = problem.parameters.get("solver.frame_time") / passes_per_frame(problem.parameters);
    terms_ = {&edges_, &hinges_.items(), problem.parameters.get("solver.bending"), h,
              1.0 - 1.0 / static_cast<double>(plan.relax)};
    springs_ = {static_cast<float>(terms_.share), static_cast<float>(thin_hinge_compliance(terms_))};
    mass_.reserve(plan.record_of_vertex.size());
    for (const int record : plan.record_of_vertex)
        mass_.push_back(static_cast<double>(plan.inverse_mass[static_cast<std::size_t>(record)]));
    for (std::vector<Row>* records : {&forces_, &moves_, &reference_})
        records->assign(4 * plan.groups, Row{});
    motion_.assign(2 * 4 * max_clusters / packet, Row{});
    squares_.assign(plan.chunks.size(), 0.0);
    stiffness_.assign(plan.interiors.size() + plan.interfaces.size(), 0.0);
    for (auto* values : {&q_, &r_, &qg_, &g_})
        values->resize(static_cast<std::size_t>(matrix_.basis().unknowns()));
    normals_.resize(plan.rest.size());
    make_members(plan);
    matrix_.prepare(terms_);
}

void FastCoarse::make_members(const Plan& plan) {
    const auto& weights = matrix_.basis().weights();
    const auto count = static_cast<std::size_t>(matrix_.basis().clusters());
    std::vector<std::vector<std::pair<std::size_t, float>>> lists(count);
    shares_.assign(plan.groups, CoarseShare{});
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const auto r = static_cast<std::size_t>(plan.record_of_vertex[i]);
        for (std::size_t k = 0; k < 4; ++k) {
            const float w = weights[i].weight[k];
            const auto cluster = static_cast<std::size_t>(weights[i].cluster[k]);
            shares_[r / packet].weight[k][r % packet] = w;
            shares_[r / packet].cluster[k][r % packet] = static_cast<std::uint16_t>(cluster);
            if (w > 0.0f)
                lists[cluster].emplace_back(r, w);
        }
    }
    sums_.resize(count);
    for (auto& list : lists) {
        std::sort(list.begin(), list.end());
        std::vector<MemberPacket> packets;
        for (std::size_t i = 0; i < list.size();) {
            MemberPacket next{};
            next.base = static_cast<std::uint32_t>(list[i].first);
            for (std::size_t k = 0; k < packet && i < list.size() && list[i].first - next.base <= 65535;
                 ++k, ++i) {
                next.index[k] = static_cast<std::uint16_t>(list[i].first - next.base);
                next.weight[k] = list[i].second;
            }
            packets.push_back(next);
        }
        packets.shrink_to_fit();
        members_.push_back(std::move(packets));
    }
    // By where their members lie, so that a thread sums over about the vertices that it has just worked on.
    std::vector<std::pair<double, std::size_t>> places;
    for (std::size_t m = 0; m < count; ++m) {
        double place = 0;
        for (const auto& [record, weight] : lists[m])
            place += static_cast<double>(record);
        places.emplace_back(place / static_cast<double>(std::max<std::size_t>(lists[m].size(), 1)), m);
    }
    std::sort(places.begin(), places.end());
    order_.clear();
    work_before_.assign(1, 0);
    for (const auto& [place, m] : places) {
        order_.push_back(m);
        work_before_.push_back(work_before_.back() + members_[m].size());
    }
}

void FastCoarse::clear(const GroupRange& range) {
    std::fill(forces_.begin() + static_cast<std::ptrdiff_t>(4 * range.begin),
              forces_.begin() + static_cast<std::ptrdiff_t>(4 * range.end), Row{});
}

void FastCoarse::push(const float* records, const ConstraintSet& set) {
    const std::size_t first = 4 * set.first_record;
    kernels_.edge_forces(records + first, floats(forces_) + first, plan_.edges.data() + set.first_edge,
                         set.edges);
    kernels_.hinge_forces(records + first, floats(forces_) + first, plan_.hinges.data() + set.first_hinge,
                          set.hinges, springs_);
}

void FastCoarse::load(const VertexArrays& v, const GroupRange& range) {
    kernels_.loads(v, range.begin, range.end, static_cast<float>(pressure_), floats(forces_), floats(moves_));
}

void FastCoarse::sum(const float* records, int thread, int threads, bool with_frames) {
    const std::size_t all = work_before_.back() + 1;
    for (std::size_t i = 0; i < order_.size(); ++i)
        if (work_before_[i] * static_cast<std::size_t>(threads) / all == static_cast<std::size_t>(thread))
            sum_cluster(records, order_[i], with_frames);
}

void FastCoarse::sum_cluster(const float* records, std::size_t cluster, bool with_frames) {
    ClusterSums& s = sums_[cluster];
    const CoarseMembers members{members_[cluster].data(), members_[cluster].size()};
    if (with_frames && assemblies_ > 0)
        kernels_.sum_shape(records, floats(reference_), members, s.centres, s.shape);
    kernels_.sum_loads(records, floats(forces_), floats(moves_), members, s.centre, s.load);
}

void FastCoarse::copy_state(const VertexArrays& v) {
    Points& positions = matrix_.basis().reference();
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const auto r = static_cast<std::size_t>(plan_.record_of_vertex[i]);
        const VertexGroup& group = v.groups[r / packet];
        for (std::size_t k = 0; k < 3; ++k) {
            const auto c = static_cast<Eigen::Index>(k);
            positions[i][c] = static_cast<double>(v.records[4 * r + k]);
            normals_[i][c] = group.touched != 0 ? static_cast<double>(group.normal[k][r % packet]) : 0.0;
        }
    }
    std::copy(v.records, v.records + 4 * plan_.records(), floats(reference_));
}

void FastCoarse::prepare(const VertexArrays& v, bool with_frames) {
    if (with_frames && assemblies_ > 0)
        for (std::size_t m = 0; m < sums_.size(); ++m) {
            const ClusterSums& s = sums_[m];
            Mat3 moment;
            for (Eigen::Index i = 0; i < 3; ++i)
                for (Eigen::Index j = 0; j < 3; ++j)
                    moment(i, j) = static_cast<double>(s.shape[3 + 3 * i + j]);
            matrix_.basis().set_frame(static_cast<int>(m), vec(s.centres), vec(s.shape), moment);
        }
    renew_ = assemblies_ == 0 || stale_ || (with_frames && matrix_.outdated());
    if (!renew_)
        return;
    copy_state(v);
    matrix_.begin(matrix_.basis().reference(), terms_);
    for (std::size_t m = 0; m < sums_.size(); ++m)
        for (std::size_t k = 0; k < 3; ++k)
            sums_[m].centres[3 + k] =
                static_cast<float>(matrix_.basis().centre(static_cast<int>(m))[static_cast<Eigen::Index>(k)]);
}

void FastCoarse::solve(std::optional<double> volume_error, bool with_frames) {
    const ClusterBasis& basis = matrix_.basis();
    if (renew_) {
        matrix_.finish();
        age_ = 0;
        stale_ = false;
        ++assemblies_;
    }
    ++age_;
    ++steps_;
    // Moments were formed about the centres of the step before: they are moved to the present ones here.
    const double per_radius = 1.0 / basis.radius();
    for (std::size_t m = 0; m < sums_.size(); ++m) {
        ClusterSums& s = sums_[m];
        const Vec3 centre = basis.centre(static_cast<int>(m));
        const Mat3 back = basis.turn(static_cast<int>(m)).transpose();
        const auto into = [&](const float* sum, std::vector<float>& out) {
            const Vec3 force = vec(sum), torque = vec(sum + 3) + (vec(s.centre) - centre).cross(force);
            const Vec3 f = back * force, t = per_radius * (back * torque);
            for (Eigen::Index k = 0; k < 3; ++k) {
                out[6 * m + static_cast<std::size_t>(k)] = static_cast<float>(f[k]);
                out[6 * m + 3 + static_cast<std::size_t>(k)] = static_cast<float>(t[k]);
            }
        };
        into(s.load, r_);
        into(s.load + 6, g_);
    }
    q_ = r_;
    matrix_.solve(q_);
    // Only a way to change the volume, so it need not be of this very substep, as long as it still does: contacts that come and
    // go change what the volume's gradient can push.
    double gain = dot(g_, qg_);
    if (with_frames || age_ == 1 || !(gain > 0.8 * gain_ && gain < 1.25 * gain_)) {
        qg_ = g_;
        matrix_.solve(qg_);
        gain = gain_ = dot(g_, qg_);
    }
    more_ = gain > 0.0 && volume_error ? (-*volume_error - dot(g_, q_)) / gain : 0.0;
    for (std::size_t i = 0; i < q_.size(); ++i)
        q_[i] += static_cast<float>(more_) * qg_[i];
    slope_ = dot(r_, q_) + more_ * dot(g_, q_);
    float* motion = floats(motion_);
    for (std::size_t m = 0; m < sums_.size(); ++m) {
        const Vec3 centre = basis.centre(static_cast<int>(m));
        const Mat3 turn = basis.turn(static_cast<int>(m));
        const Vec3 omega = per_radius * (turn * vec(&q_[6 * m + 3])),
                   u = turn * vec(&q_[6 * m]) - omega.cross(centre);
        for (std::size_t k = 0; k < 3; ++k) {
            motion[4 * m + k] = static_cast<float>(u[static_cast<Eigen::Index>(k)]);
            motion[4 * (max_clusters + m) + k] = static_cast<float>(omega[static_cast<Eigen::Index>(k)]);
            sums_[m].centre[k] = static_cast<float>(centre[static_cast<Eigen::Index>(k)]);
            sums_[m].centres[k] = sums_[m].centre[k];
        }
    }
}

void FastCoarse::spread(const VertexArrays& v, const GroupRange& range, std::size_t chunk) {
    squares_[chunk] =
        kernels_.spread(v, shares_.data(), range.begin, range.end, floats(motion_), floats(moves_));
}

void FastCoarse::bend(const float* records, const ConstraintSet& set, std::size_t number) {
    const std::size_t first = 4 * set.first_record,
                      phase = static_cast<std::size_t>(steps_) % curvature_stride;
    const std::size_t edge = std::min(phase, set.edges), hinge = std::min(phase, set.hinges);
    stiffness_[number] = kernels_.edge_stiffness(records + first, floats(moves_) + first,
                                                 plan_.edges.data() + set.first_edge + edge, set.edges - edge,
                                                 curvature_stride) +
                         kernels_.hinge_stiffness(records + first, floats(moves_) + first,
                                                  plan_.hinges.data() + set.first_hinge + hinge,
                                                  set.hinges - hinge, curvature_stride, springs_);
}

double FastCoarse::length() const {
    double bend = 0;
    for (const double s : stiffness_)
        bend += s;
    bend *= static_cast<double>(curvature_stride);
    for (const double s : squares_)
        bend += s;
    const double length = bend > 0.0 ? std::clamp(slope_ / bend, 0.0, longest_step) : 0.0;
    return std::isfinite(length) && std::isfinite(more_) ? length : 0.0;
}

void FastCoarse::apply(const VertexArrays& v, const GroupRange& range, double length) {
    if (length > 0.0)
        kernels_.apply(v.records, floats(moves_), range.begin, range.end, static_cast<float>(length));
}

void FastCoarse::conclude(double length) {
    stale_ = age_ >= least_matrix_age && length < short_step;
    pressure_ = std::isfinite(more_) && std::isfinite(slope_) ? pressure_ + more_ : 0.0;
}

std::size_t FastCoarse::bytes() const {
    std::size_t total = matrix_.bytes() + bytes_of(forces_, moves_, reference_, shares_, sums_, motion_,
                                                   edges_, hinges_.items(), mass_, normals_);
    for (const auto& list : members_)
        total += bytes_of(list);
    return total;
}

} // namespace fascicle::solver::fast
