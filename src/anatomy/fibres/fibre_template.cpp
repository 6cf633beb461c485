#include "fascicle/anatomy/fibre_template.hpp"

#include "fascicle/base/error.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle {

namespace {

constexpr std::size_t most_points = 8;

struct Curve {
    std::array<Vec2, most_points> points;
    std::size_t count = 0;
    double weight = 1;
};

Curve raised(const FibrePolygon& polygon, std::size_t count) {
    Curve curve;
    curve.weight = polygon.weight;
    const std::size_t middle = polygon.points.size() / 2;
    for (std::size_t i = 0; i < polygon.points.size(); ++i) {
        curve.points[curve.count++] = polygon.points[i];
        if (i == middle && polygon.points.size() < count)
            curve.points[curve.count++] = polygon.points[i];
    }
    return curve;
}

Curve blended(const Curve& a, const Curve& b, double share) {
    Curve curve = a;
    for (std::size_t i = 0; i < a.count; ++i)
        curve.points[i] = (1.0 - share) * a.points[i] + share * b.points[i];
    curve.weight = (1.0 - share) * a.weight + share * b.weight;
    return curve;
}

Curve across(const std::vector<FibrePolygon>& polygons, double s, std::size_t count) {
    std::size_t k = 0;
    while (k + 2 < polygons.size() && s > polygons[k + 1].s)
        ++k;
    const FibrePolygon &a = polygons[k], &b = polygons[k + 1];
    return blended(raised(a, count), raised(b, count), std::clamp((s - a.s) / (b.s - a.s), 0.0, 1.0));
}

std::size_t highest_count(const std::vector<FibrePolygon>& polygons) {
    std::size_t count = 0;
    for (const FibrePolygon& polygon : polygons)
        count = std::max(count, polygon.points.size());
    return count;
}

void check_side(const std::vector<FibrePolygon>& side, const std::string& where, const char* name) {
    const std::string here = where + ": " + name;
    if (side.size() < 2 || side.size() > 64)
        throw_error(here, std::to_string(side.size()) + " polygons", "2 to 64");
    for (std::size_t k = 0; k < side.size(); ++k) {
        const std::string polygon = here + "[" + std::to_string(k) + "]";
        const double lowest = k == 0 ? 0.0 : side[k - 1].s;
        if (!(side[k].s >= lowest && side[k].s <= 1.0) || (k > 0 && !(side[k].s > lowest)) ||
            (k == 0 && side[k].s != 0.0) || (k + 1 == side.size() && side[k].s != 1.0))
            throw_error(polygon, "s is " + std::to_string(side[k].s), "s rising from 0 to 1");
        if (side[k].points.size() < 2 || side[k].points.size() > most_points)
            throw_error(polygon, std::to_string(side[k].points.size()) + " points",
                        "2 to " + std::to_string(most_points));
        for (const Vec2& p : side[k].points)
            if (!((p.array() >= 0.0).all() && (p.array() <= 1.0).all()))
                throw_error(polygon, "point (" + std::to_string(p.x()) + ", " + std::to_string(p.y()) + ")",
                            "coordinates from 0 to 1");
        if (!(side[k].weight > 0.0 && side[k].weight <= 1e6))
            throw_error(polygon, "weight is " + std::to_string(side[k].weight), "above 0, at most 1000000");
    }
}

} // namespace

Vec3 FibreTemplate::point(double r, double s, double t) const {
    const std::vector<FibrePolygon>& behind = back.empty() ? front : back;
    const std::size_t count = std::max(highest_count(front), highest_count(behind));
    Curve curve = across(front, s, count);
    if (!back.empty())
        curve = blended(curve, across(behind, s, count), r);
    // Bernstein polynomials by their recurrence in the degree.
    std::array<double, most_points> basis{1.0};
    for (std::size_t degree = 1; degree < curve.count; ++degree)
        for (std::size_t i = degree + 1; i-- > 0;)
            basis[i] = (i < degree ? (1.0 - t) * basis[i] : 0.0) + (i > 0 ? t * basis[i - 1] : 0.0);
    Vec2 sum = Vec2::Zero();
    double weights = 0;
    for (std::size_t i = 0; i < curve.count; ++i) {
        const double w = (i == 0 || i + 1 == curve.count ? 1.0 : curve.weight) * basis[i];
        sum += w * curve.points[i];
        weights += w;
    }
    sum /= weights;
    return {sum.x(), sum.y(), r};
}

void check_template(const FibreTemplate& fibre_template, const std::string& where) {
    check_side(fibre_template.front, where, "front");
    if (!fibre_template.back.empty())
        check_side(fibre_template.back, where, "back");
    std::size_t fewest = most_points, most = 0;
    for (const auto* side : {&fibre_template.front, &fibre_template.back})
        for (const FibrePolygon& polygon : *side) {
            fewest = std::min(fewest, polygon.points.size());
            most = std::max(most, polygon.points.size());
        }
    for (const auto& [side, name] :
         {std::pair(&fibre_template.front, "front"), {&fibre_template.back, "back"}})
        for (std::size_t k = 0; k < side->size(); ++k)
            if (const auto& points = (*side)[k].points; !(points.back().y() > points.front().y()))
                throw_error(where,
                            std::string(name) + "[" + std::to_string(k) +
                                "]: the fibre ends no nearer to the insertion "
                                "(y = 1) than it begins",
                            "points from the origin's side to the insertion's");
    if (most > fewest + 1)
        throw_error(where,
                    "polygons of " + std::to_string(fewest) + " and " + std::to_string(most) + " points",
                    "numbers of points that differ by one at most");
}

const FibreTemplate& parallel_template() {
    static const FibreTemplate parallel{
        "parallel",
        "Parallel",
        "Straight fibres side by side from origin to insertion.",
        {{0.0, {Vec2(0, 0), Vec2(0, 1)}, 1.0}, {1.0, {Vec2(1, 0), Vec2(1, 1)}, 1.0}},
        {}};
    return parallel;
}

} // namespace fascicle
