// Distance of fibres to their nearest neighbours.

#include "fascicle/anatomy/fibre_architecture.hpp"

#include "fascicle/base/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fascicle {

namespace {

double squared_distance(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 ab = b - a, ap = p - a;
    const double l2 = ab.squaredNorm();
    const double s = l2 > 0.0 ? std::clamp(ap.dot(ab) / l2, 0.0, 1.0) : 0.0;
    return (ap - s * ab).squaredNorm();
}

struct Box {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
    Vec3 high = -low;
    void add(const Vec3& p) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    double squared_distance(const Vec3& p) const {
        return (low - p).cwiseMax(p - high).cwiseMax(0.0).squaredNorm();
    }
};

/// Fibres in pieces of a few segments with a box each: fibres are long and run at a slant, their own boxes would
/// overlap nearly all others.
class NearestFibre {
public:
    explicit NearestFibre(const FibreSet& fibres) : fibres_(fibres) {
        for (int f = 0; f < fibres.count; ++f) {
            const std::span<const Vec3> fibre = fibres.fibre(f);
            Box whole;
            for (const Vec3& p : fibre)
                whole.add(p);
            fibre_boxes_.push_back(whole);
            for (std::size_t j = 0; j + 1 < fibre.size(); j += piece) {
                Box box;
                for (std::size_t i = j; i <= std::min(j + piece, fibre.size() - 1); ++i)
                    box.add(fibre[i]);
                piece_boxes_.push_back(box);
            }
        }
        pieces_ = (static_cast<std::size_t>(fibres.segments) + piece - 1) / piece;
    }

    /// Distance of p to the nearest fibre but `own`. hint: a fibre that is probably near, or own; the nearest
    /// afterwards.
    double distance(const Vec3& p, int own, int& hint) const {
        double best = std::numeric_limits<double>::infinity();
        if (hint != own)
            look_at(hint, p, best);
        for (int f = 0; f < fibres_.count; ++f)
            if (f != own && fibre_boxes_[static_cast<std::size_t>(f)].squared_distance(p) < best)
                if (look_at(f, p, best))
                    hint = f;
        return std::sqrt(best);
    }

private:
    static constexpr std::size_t piece = 4;

    bool look_at(int f, const Vec3& p, double& best) const {
        const std::span<const Vec3> fibre = fibres_.fibre(f);
        bool nearer = false;
        for (std::size_t c = 0; c < pieces_; ++c) {
            if (!(piece_boxes_[static_cast<std::size_t>(f) * pieces_ + c].squared_distance(p) < best))
                continue;
            for (std::size_t j = c * piece; j < std::min((c + 1) * piece, fibre.size() - 1); ++j)
                if (const double d = squared_distance(p, fibre[j], fibre[j + 1]); d < best) {
                    best = d;
                    nearer = true;
                }
        }
        return nearer;
    }

    const FibreSet& fibres_;
    std::vector<Box> fibre_boxes_, piece_boxes_;
    std::size_t pieces_ = 0;
};

} // namespace

std::vector<double> fibre_radii(const FibreSet& fibres, int threads) {
    std::vector<double> radii(static_cast<std::size_t>(fibres.count),
                              std::numeric_limits<double>::quiet_NaN());
    if (fibres.count < 2)
        return radii;
    const NearestFibre nearest(fibres);
    parallel_for(threads, radii.size(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            const int own = static_cast<int>(f);
            int hint = own;
            double sum = 0.0;
            for (const Vec3& p : fibres.fibre(own))
                sum += nearest.distance(p, own, hint);
            radii[f] = 0.5 * sum / static_cast<double>(fibres.points_per_fibre());
        }
    });
    return radii;
}

} // namespace fascicle
