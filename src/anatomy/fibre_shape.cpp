#include "fascicle/anatomy/fibre_shape.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/error.hpp"

#include <limits>

namespace fascicle {

namespace {

bool same_shape(const FibreSet& a, const FibreSet& b) {
    return a.count == b.count && a.segments == b.segments && a.points.size() == b.points.size();
}

double ratio(double now, double rest) {
    return rest > 0.0 ? now / rest : std::numeric_limits<double>::quiet_NaN();
}

double length(std::span<const Vec3> fibre, std::size_t segment) {
    return (fibre[segment + 1] - fibre[segment]).norm();
}

} // namespace

void check_fibres(const FibreSet& fibres, const std::string& where) {
    if (fibres.count < 0 || fibres.segments < 1)
        throw_error(where,
                    std::to_string(fibres.count) + " fibres of " + std::to_string(fibres.segments) +
                        " segments",
                    "0 or more fibres of 1 or more segments");
    const std::size_t wanted = static_cast<std::size_t>(fibres.count) * fibres.points_per_fibre();
    if (fibres.points.size() != wanted)
        throw_error(where, std::to_string(fibres.points.size()) + " fibre points",
                    std::to_string(wanted) + " (" + std::to_string(fibres.count) + " fibres of " +
                        std::to_string(fibres.points_per_fibre()) + ")");
    for (std::size_t i = 0; i < fibres.points.size(); ++i)
        if (!fibres.points[i].allFinite())
            throw_error(where,
                        "point " + std::to_string(i % fibres.points_per_fibre()) + " of fibre " +
                            std::to_string(i / fibres.points_per_fibre()) + " is not finite",
                        "finite coordinates");
}

std::vector<double> fibre_lengths(const FibreSet& fibres) {
    std::vector<double> lengths;
    fibre_lengths(fibres, lengths);
    return lengths;
}

void fibre_lengths(const FibreSet& fibres, std::vector<double>& lengths) {
    lengths.resize(static_cast<std::size_t>(fibres.count));
    for (int f = 0; f < fibres.count; ++f) {
        const std::span<const Vec3> fibre = fibres.fibre(f);
        double sum = 0.0;
        for (std::size_t j = 0; j + 1 < fibre.size(); ++j)
            sum += length(fibre, j);
        lengths[static_cast<std::size_t>(f)] = sum;
    }
}

std::vector<double> fibre_strains(std::span<const double> lengths, std::span<const double> rest_lengths) {
    FASCICLE_ASSERT(lengths.size() == rest_lengths.size());
    std::vector<double> strains(lengths.size());
    for (std::size_t f = 0; f < lengths.size(); ++f)
        strains[f] = ratio(lengths[f] - rest_lengths[f], rest_lengths[f]);
    return strains;
}

std::vector<double> segment_stretch(const FibreSet& fibres, const FibreSet& rest) {
    FASCICLE_ASSERT(same_shape(fibres, rest));
    std::vector<double> stretch;
    stretch.reserve(static_cast<std::size_t>(fibres.count) * static_cast<std::size_t>(fibres.segments));
    for (int f = 0; f < fibres.count; ++f)
        for (std::size_t j = 0; j + 1 < fibres.points_per_fibre(); ++j)
            stretch.push_back(ratio(length(fibres.fibre(f), j), length(rest.fibre(f), j)));
    return stretch;
}

std::vector<double> point_stretch(const FibreSet& fibres, const FibreSet& rest) {
    FASCICLE_ASSERT(same_shape(fibres, rest));
    std::vector<double> stretch;
    stretch.reserve(fibres.points.size());
    const std::size_t last = fibres.points_per_fibre() - 1;
    for (int f = 0; f < fibres.count; ++f)
        for (std::size_t j = 0; j <= last; ++j) {
            double now = 0.0, then = 0.0;
            for (const std::size_t segment : {j - 1, j}) // j - 1 wraps round at 0, and is then no segment
                if (segment < last) {
                    now += length(fibres.fibre(f), segment);
                    then += length(rest.fibre(f), segment);
                }
            stretch.push_back(ratio(now, then));
        }
    return stretch;
}

Points fibre_tangents(const FibreSet& fibres) {
    Points tangents(fibres.points.size(), Vec3::Zero());
    const std::size_t points = fibres.points_per_fibre();
    for (int f = 0; f < fibres.count; ++f) {
        const std::span<const Vec3> fibre = fibres.fibre(f);
        const std::span<Vec3> tangent(tangents.data() + static_cast<std::size_t>(f) * points, points);
        // Forwards: the last segment with a length up to each point. Then backwards: the first one after it.
        Vec3 before = Vec3::Zero();
        for (std::size_t j = 1; j < points; ++j) {
            const Vec3 step = fibre[j] - fibre[j - 1];
            if (step.squaredNorm() > 0.0)
                before = step;
            tangent[j] = before;
        }
        Vec3 after = Vec3::Zero();
        for (std::size_t j = points; j-- > 0;) {
            if (j + 1 < points)
                if (const Vec3 step = fibre[j + 1] - fibre[j]; step.squaredNorm() > 0.0)
                    after = step;
            before = tangent[j];
            const Vec3 u = before.stableNormalized(), v = after.stableNormalized();
            Vec3 sum = u * after.stableNorm() + v * before.stableNorm();
            if (before.isZero(0.0) || after.isZero(0.0))
                sum = u + v;
            else if ((u + v).norm() <= 1e-12)
                sum = u;
            tangent[j] = sum.stableNormalized();
        }
    }
    return tangents;
}

} // namespace fascicle
