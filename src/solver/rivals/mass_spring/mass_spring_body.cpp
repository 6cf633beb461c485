#include "solver/rivals/mass_spring/mass_spring_body.hpp"

#include "solver/rivals/mass_spring/point_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fascicle {

std::unique_ptr<SoftBodySolver> make_mass_spring_solver(const SoftBodyProblem& problem) {
    return std::make_unique<mass_spring::MassSpringBody>(problem);
}

namespace mass_spring {

namespace {

std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

} // namespace

MassSpringBody::MassSpringBody(const SoftBodyProblem& given)
    : RivalBody(given), volume_(rest(), problem().surface->triangles, param("solver.pressure"),
                                problem().parameters.get_choice("solver.volume") == "kept"),
      damping_(param("mass-spring.damping")), steps_(problem().parameters.get_int("mass-spring.steps")),
      passes_(passes_per_frame(problem().parameters)), bound_(rest()) {
    const SolidQuery solid(*problem().surface);
    build(solid);
    body_.assign(particles_.size(), -1);
    std::vector<char> fixed(particles_.size(), 0);
    for (std::size_t i = 0; i < particles_.size(); ++i)
        if (particles_.vertex[i] >= 0) {
            body_[i] = problem().body_of_vertex[at(particles_.vertex[i])];
            fixed[i] = body_[i] >= 0;
        }
    const auto layout = static_cast<SpringLayout>(problem().parameters.get_int("mass-spring.springs"));
    net_ = SpringNet(particles_.rest, std::move(fixed), make_springs(particles_, layout, solid, topology()));
    fit_carry();
    clear_.assign(particles_.size(), 0.0);
    looked_at_ = particles_.rest;
    push_.assign(particles_.size(), Vec3::Zero());
    share_.assign(particles_.size(), 0.0);
    stopped_.assign(particles_.size(), 0);
}

/// Vertices that particles round about cannot hold become particles themselves.
void MassSpringBody::build(const SolidQuery& solid) {
    const Mat3 axes = lattice_axes(*problem().surface, topology(), problem().edge_along);
    std::vector<char> wanted(rest().size(), 0);
    for (std::size_t i = 0; i < wanted.size(); ++i)
        wanted[i] = is_free(i);
    std::vector<int> extra, failed;
    do {
        extra.insert(extra.end(), failed.begin(), failed.end());
        particles_ = sample_particles(*problem().surface, topology(), problem().body_of_vertex, solid, axes,
                                      problem().parameters.get_int("mass-spring.particles"), extra);
        std::vector<int> particle_of(rest().size(), -1);
        for (std::size_t i = 0; i < particles_.size(); ++i)
            if (particles_.vertex[i] >= 0)
                particle_of[at(particles_.vertex[i])] = static_cast<int>(i);
        const double cell = particles_.spacing > 0.0 ? 1.5 * particles_.spacing : 1.0;
        binding_ = bind_to_particles(particles_.rest, particle_of, rest(), wanted, cell, failed);
    } while (!failed.empty());
}

/// Boundary particles have their vertex's weights. Inner ones: mean over the 12 nearest of those, by 1 / distance^2; never 0 apart,
/// since they are half a spacing deep.
void MassSpringBody::fit_carry() {
    const std::size_t bodies = solids().size();
    if (bodies == 0 || problem().carry_weights.empty())
        return;
    constexpr std::size_t nearest = 12;
    carry_.assign(particles_.size() * bodies, 0.0);
    PointCells cells(particles_.spacing > 0.0 ? 1.5 * particles_.spacing : 1.0);
    std::vector<NearPoint> near;
    for (std::size_t i = 0; i < particles_.size(); ++i) {
        double* row = &carry_[i * bodies];
        if (particles_.vertex[i] >= 0) {
            cells.add(particles_.rest[i]);
            if (body_[i] >= 0)
                row[at(body_[i])] = 1.0;
            else
                std::copy_n(&problem().carry_weights[at(particles_.vertex[i]) * bodies], bodies, row);
            continue;
        }
        cells.nearest(particles_.rest[i], nearest, near);
        double total = 0;
        for (const NearPoint& n : near)
            total += 1.0 / n.squared_distance;
        for (const NearPoint& n : near)
            for (std::size_t b = 0; b < bodies; ++b)
                row[b] += carry_[at(n.point) * bodies + b] / (n.squared_distance * total);
    }
}

std::size_t MassSpringBody::state_bytes() const {
    return RivalBody::state_bytes() + net_.bytes() + binding_.bytes() + volume_.bytes() +
           bytes_of(particles_.rest, particles_.vertex, body_, carry_, bound_, push_, share_, stopped_,
                    clear_, looked_at_);
}

bool MassSpringBody::set_state(const Points& positions, const Points&) {
    const auto inner =
        std::find_if(particles_.vertex.begin(), particles_.vertex.end(), [](int v) { return v < 0; });
    const auto boundary = static_cast<std::size_t>(inner - particles_.vertex.begin());
    const Points rest_boundary(particles_.rest.begin(), particles_.rest.begin() + std::ptrdiff_t(boundary));
    const Points rest_inner(particles_.rest.begin() + std::ptrdiff_t(boundary), particles_.rest.end());
    Points now(boundary), now_inner = rest_inner;
    for (std::size_t i = 0; i < boundary; ++i)
        now[i] = positions[at(particles_.vertex[i])];
    std::vector<int> failed;
    const Binding binding =
        bind_to_particles(rest_boundary, std::vector<int>(rest_inner.size(), -1), rest_inner,
                          std::vector<char>(rest_inner.size(), 1), 1.5 * particles_.spacing, failed);
    if (!failed.empty())
        return false;
    binding.apply(now, now_inner);
    x() = positions;
    for (std::size_t i = 0; i < particles_.size(); ++i)
        net_.stop_at(i, i < boundary ? now[i] : now_inner[i - boundary]);
    return true;
}

void MassSpringBody::carry_particles() {
    const std::size_t bodies = solids().size();
    for (std::size_t i = 0; i < particles_.size(); ++i) {
        if (body_[i] >= 0) {
            net_.stop_at(i, x()[at(particles_.vertex[i])]);
            continue;
        }
        if (carry_.empty())
            continue;
        const Vec3& p = net_.positions()[i];
        Vec3 shift = Vec3::Zero();
        for (std::size_t b = 0; b < bodies; ++b)
            if (const double w = carry_[i * bodies + b]; w != 0.0)
                shift += w * (solids()[b].now.apply(solids()[b].before.apply_inverse(p)) - p);
        if (shift.allFinite())
            net_.carry_to(i, p + shift);
    }
}

void MassSpringBody::deform(double) {
    carry_particles();
    still_ = solids();
    for (solver::ContactSolid& solid : still_)
        solid.before = solid.now;
    std::fill(clear_.begin(), clear_.end(), 0.0);
    // Steps done by the end of this pass, less those before it.
    const int steps = (pass_ + 1) * steps_ / passes_ - pass_ * steps_ / passes_;
    pass_ = (pass_ + 1) % passes_;
    std::size_t refused = 0;
    for (int k = 0; k < steps; ++k) {
        refused += net_.step(time_step, damping_);
        if (!still_.empty())
            collide();
        if (volume_.kept())
            keep_volume();
    }
    binding_.apply(net_.positions(), x(), problem().threads);
    bound_ = x();
    // The base refuses and counts a position that is not finite.
    if (refused > 0)
        for (std::size_t i = 0; i < particles_.size(); ++i)
            if (particles_.vertex[i] >= 0 && body_[i] < 0 && !net_.positions()[i].allFinite())
                x()[at(particles_.vertex[i])].setConstant(std::numeric_limits<double>::quiet_NaN());
}

/// In every step, as Janak does: a particle that is too near to a solid is put outside and loses its velocity. Inner ones, too: his
/// spheres leave no way between boundary particles, single points do.
/// Solids stand still within a pass, so who is farther from all of them than it has gone since it was looked at is passed over.
void MassSpringBody::collide() {
    for (std::size_t i = 0; i < particles_.size(); ++i) {
        Vec3 p = net_.positions()[i];
        if (body_[i] >= 0 || (p - looked_at_[i]).norm() < clear_[i])
            continue;
        if (resolve_contact(p, net_.before()[i], still_, contact()).touched && p.allFinite())
            net_.stop_at(i, p);
        looked_at_[i] = p;
        clear_[i] = std::numeric_limits<double>::infinity();
        for (const solver::ContactSolid& solid : still_)
            clear_[i] = std::min(
                clear_[i], (solid.grid->value(solid.now.apply_inverse(p)) - contact().offset) / solid.slope);
    }
}

/// Hong, Jung, Choi, Welch 2006: after each step the points of the closed surface go along the gradient of its volume, as far as the
/// volume is kept to first order. The points here are blends of particles, x = W p, so grad_p V = W^T grad_x V.
void MassSpringBody::keep_volume() {
    binding_.apply(net_.positions(), bound_);
    for (std::size_t i = 0; i < bound_.size(); ++i)
        if (!is_free(i))
            bound_[i] = x()[i];
    const double limit = solver::VolumeConstraint::max_step * std::abs(volume_.rest_volume());
    const double off = std::clamp(volume_.evaluate(bound_) - volume_.wanted_volume(), -limit, limit);
    binding_.transpose(volume_.gradient(), push_);
    double weight = 0;
    for (std::size_t i = 0; i < push_.size(); ++i)
        if (body_[i] < 0)
            weight += push_[i].squaredNorm();
    if (!(weight > 0.0) || !std::isfinite(off / weight))
        return;
    for (std::size_t i = 0; i < push_.size(); ++i)
        if (body_[i] < 0)
            net_.move(i, -off / weight * push_[i]);
}

/// What contact and volume step did to the surface is handed to its particles: each goes by the weighted mean of what its vertices
/// went, and stops where a solid held one of them.
void MassSpringBody::contacted() {
    std::fill(push_.begin(), push_.end(), Vec3::Zero());
    std::fill(share_.begin(), share_.end(), 0.0);
    std::fill(stopped_.begin(), stopped_.end(), 0);
    for (std::size_t v = 0; v < bound_.size(); ++v) {
        const Vec3 moved = x()[v] - bound_[v];
        if (!is_free(v) || moved.isZero(0.0) || !moved.allFinite())
            continue;
        const bool held = !contact_normals()[v].isZero(0.0);
        for (std::size_t k = 0; k < binding_.particles(v).size(); ++k) {
            const auto p = static_cast<std::size_t>(binding_.particles(v)[k]);
            const double w = std::max(binding_.weights(v)[k], 0.0);
            push_[p] += w * moved;
            share_[p] += w;
            stopped_[p] = stopped_[p] != 0 || (held && w > 0.5);
        }
    }
    for (std::size_t i = 0; i < push_.size(); ++i) {
        if (body_[i] >= 0 || share_[i] == 0.0)
            continue;
        const Vec3 p = net_.positions()[i] + push_[i] / std::max(share_[i], 1.0);
        if (stopped_[i] != 0)
            net_.stop_at(i, p);
        else
            net_.carry_to(i, p);
    }
}

} // namespace mass_spring
} // namespace fascicle
