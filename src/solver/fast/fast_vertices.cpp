#include "solver/fast/fast_vertices.hpp"

#include <algorithm>

namespace fascicle::solver::fast {

FastVertices::FastVertices(const SoftBodyProblem& problem, const Plan& plan) {
    make_records(plan);
    make_groups(problem, plan);
    make_fixed_groups(problem, plan);
}

void FastVertices::make_records(const Plan& plan) {
    records_.resize(4 * plan.groups);
    auto* records = reinterpret_cast<float*>(records_.data());
    // Padding gets the corners of a hinge without slivers; nothing ever moves it.
    constexpr float corners[4][3] = {{0.5f, 1, 0}, {0.5f, -1, 0}, {0, 0, 0}, {1, 0, 0}};
    for (std::size_t r = 0; r < plan.records(); ++r)
        for (std::size_t k = 0; k < 3; ++k)
            records[4 * r + k] = corners[r % 4][k];
    vertex_of_record_.assign(plan.records(), -1);
    for (std::size_t i = 0; i < plan.rest.size(); ++i) {
        const auto r = static_cast<std::size_t>(plan.record_of_vertex[i]);
        vertex_of_record_[r] = static_cast<int>(i);
        for (std::size_t k = 0; k < 3; ++k)
            records[4 * r + k] = static_cast<float>(plan.rest[i][static_cast<Eigen::Index>(k)]);
        records[4 * r + 3] = plan.inverse_mass[r];
    }
}

void FastVertices::make_groups(const SoftBodyProblem& problem, const Plan& plan) {
    groups_.resize(plan.groups);
    const auto* records = reinterpret_cast<const float*>(records_.data());
    for (std::size_t g = 0; g < plan.groups; ++g) {
        VertexGroup& group = groups_[g];
        group = VertexGroup{};
        group.ring_base = plan.ring_base[g];
        group.ring_first = plan.ring_first[g];
        group.ring_length = plan.ring_length[g];
        for (std::size_t i = 0; i < packet; ++i)
            for (std::size_t k = 0; k < 3; ++k)
                group.start[k][i] = group.carried[k][i] = records[4 * (packet * g + i) + k];
    }
    const std::size_t solids = problem.solids.size();
    slack_.assign(plan.groups * solids, Row{});
    if (problem.carry_weights.empty())
        return;
    carry_.assign(plan.groups * solids, Row{});
    for (std::size_t i = 0; i < plan.rest.size(); ++i) {
        const auto r = static_cast<std::size_t>(plan.record_of_vertex[i]);
        for (std::size_t b = 0; b < solids; ++b)
            carry_[r / packet * solids + b].v[r % packet] =
                static_cast<float>(problem.carry_weights[i * solids + b]);
    }
}

void FastVertices::make_fixed_groups(const SoftBodyProblem& problem, const Plan& plan) {
    std::vector<std::array<std::size_t, 3>> fixed; // group, solid, vertex
    for (std::size_t i = 0; i < plan.rest.size(); ++i)
        if (problem.body_of_vertex[i] >= 0)
            fixed.push_back({static_cast<std::size_t>(plan.record_of_vertex[i]) / packet,
                             static_cast<std::size_t>(problem.body_of_vertex[i]), i});
    std::sort(fixed.begin(), fixed.end());
    for (const auto& [group, solid, vertex] : fixed) {
        if (fixed_.empty() || fixed_.back().group != group || fixed_.back().solid != solid) {
            FixedGroup next{};
            next.group = static_cast<std::uint32_t>(group);
            next.solid = static_cast<std::uint32_t>(solid);
            fixed_.push_back(next);
        }
        const auto lane = static_cast<std::size_t>(plan.record_of_vertex[vertex]) % packet;
        fixed_.back().mask |= 1u << lane;
        for (std::size_t k = 0; k < 3; ++k)
            fixed_.back().rest[k][lane] = static_cast<float>(plan.rest[vertex][static_cast<Eigen::Index>(k)]);
    }
    std::size_t next = 0;
    for (const GroupRange& chunk : plan.chunks) {
        first_fixed_.push_back(next);
        while (next < fixed_.size() && fixed_[next].group < chunk.end)
            ++next;
    }
    first_fixed_.push_back(next);
}

Points FastVertices::last_step(std::size_t count) const {
    Points step(count, Vec3::Zero());
    const auto* records = reinterpret_cast<const float*>(records_.data());
    for (std::size_t r = 0; r < vertex_of_record_.size(); ++r)
        for (std::size_t k = 0; vertex_of_record_[r] >= 0 && k < 3; ++k)
            step[static_cast<std::size_t>(vertex_of_record_[r])][static_cast<Eigen::Index>(k)] =
                double(records[4 * r + k]) - double(groups_[r / packet].carried[k][r % packet]);
    return step;
}

void FastVertices::set_state(const Points& positions, const Points& last_step, const Vec3& origin) {
    auto* records = reinterpret_cast<float*>(records_.data());
    for (std::size_t r = 0; r < vertex_of_record_.size(); ++r) {
        if (vertex_of_record_[r] < 0)
            continue;
        const auto i = static_cast<std::size_t>(vertex_of_record_[r]);
        const Vec3 x = positions[i] - origin;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto axis = static_cast<Eigen::Index>(k);
            records[4 * r + k] = static_cast<float>(x[axis]);
            groups_[r / packet].start[k][r % packet] = static_cast<float>(x[axis]);
            groups_[r / packet].carried[k][r % packet] = static_cast<float>(x[axis] - last_step[i][axis]);
        }
    }
}

void FastVertices::collect(const GroupRange& range, std::span<const Pose> to, const SoftBodyProblem& problem,
                           const Vec3& origin, Points& positions) const {
    const auto* records = reinterpret_cast<const float*>(records_.data());
    for (std::size_t r = packet * range.begin; r < packet * range.end; ++r) {
        const int vertex = vertex_of_record_[r];
        if (vertex < 0)
            continue;
        const auto i = static_cast<std::size_t>(vertex);
        const int body = problem.body_of_vertex[i];
        const float* p = records + 4 * r;
        positions[i] = body >= 0 ? to[static_cast<std::size_t>(body)].apply(problem.surface->positions[i])
                                 : Vec3(origin + Vec3(double(p[0]), double(p[1]), double(p[2])));
    }
}

} // namespace fascicle::solver::fast
