#pragma once
// Numbers of the painted area, kept current, and the muscle vertices that it will fix.

#include "fascicle/geometry/region_measure.hpp"

#include <future>
#include <optional>

namespace fascicle::editor {

/// Follows one area. Cheap while it does not change. During a stroke a large area, whose numbers take longer than a few
/// milliseconds, is measured four times a second; as soon as the stroke ends the numbers are right.
class PaintMeasure {
public:
    struct Numbers {
        RegionMeasure region;
        double border = 0; ///< length of all its lines, scene units
        int loops = 0;
    };
    /// region: null for an area that is not there.
    void follow(const SurfaceGraph& graph, const SurfaceRegion* region, bool stroke, double now);
    const Numbers& numbers() const { return numbers_; }
    /// The numbers are those of an earlier step of the stroke.
    bool late() const { return late_; }
    void forget() { *this = {}; }

private:
    const SurfaceGraph* graph_ = nullptr;
    std::optional<SurfaceRegion> measured_;
    Numbers numbers_;
    double cost_ = 0, at_ = 0; ///< seconds: of the last measure; when it was
    bool late_ = false;
};

/// On a thread: which vertices of a muscle an area fixes.
class FixedVertices {
public:
    ~FixedVertices() { finish(); }
    /// bone: kept alive by the caller until finish(). region: null or empty for none.
    void follow(const MeshPtr& muscle, const SurfaceGraph& bone, const SurfaceRegion* region, double unit_mm);
    void update();
    bool busy() const { return job_.valid(); }
    void finish();
    void forget();
    /// The last result; null before the first.
    const std::shared_ptr<const std::vector<int>>& vertices() const { return vertices_; }

private:
    const SurfaceGraph* bone_ = nullptr;
    MeshPtr muscle_;
    SurfaceRegion region_;
    std::shared_ptr<const std::vector<int>> vertices_;
    std::future<std::vector<int>> job_;
};

} // namespace fascicle::editor
