// Colours of DrawCache that are one number per vertex through a scale.

#include "view/draw_cache.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::view {

FloatColours DrawCache::value_colours(Object& object, const VertexValues& values, const ColourScale& scale) {
    if (values == nullptr)
        return nullptr;
    if (object.value_colours && object.value_colours_for == values && object.value_scale == scale)
        return object.value_colours;
    auto colours = std::make_shared<std::vector<render::Rgba>>();
    colours->reserve(values->size());
    for (const double value : *values)
        colours->push_back(scale.colour(value));
    object.value_colours = colours;
    object.value_colours_for = values;
    object.value_scale = scale;
    ++computed_;
    return colours;
}

FloatColours DrawCache::dihedral_colours(std::size_t muscle, const MeshPtr& mesh, const PointsPtr& rest,
                                         const PointsPtr& points, const ColourScale& scale) {
    Object& entry = object(muscles_, muscle, mesh);
    if (!entry.dihedral_change || entry.dihedral_rest != rest) {
        entry.dihedral_change = std::make_shared<const VertexDihedralChange>(topology(entry), *rest);
        entry.dihedral_rest = rest;
        entry.dihedrals = nullptr;
        ++computed_;
    }
    if (!entry.dihedrals || entry.dihedral_points != points) {
        entry.dihedrals =
            std::make_shared<const std::vector<double>>(entry.dihedral_change->measure(*points));
        entry.dihedral_points = points;
        ++computed_;
    }
    return value_colours(entry, entry.dihedrals, scale);
}

FloatColours DrawCache::distance_colours(const Scene& scene, std::size_t muscle, const PointsPtr& points,
                                         const std::vector<Pose>& poses, const ColourScale& scale) {
    Object& entry = object(muscles_, muscle, scene.muscles[muscle].mesh);
    // In steps, so that moving the end of the scale does not measure anew at every pixel.
    const double reach = std::max(1.0, std::ceil(scale.high / 10.0)) * 10.0;
    const BoneDistances distances = distances_.distances(scene, muscle, points, poses, reach);
    if (!entry.distances || entry.distances_for != distances) {
        auto values = std::make_shared<std::vector<double>>();
        values->reserve(distances->size());
        for (const BoneDistance& distance : *distances)
            values->push_back(std::max(0.0, distance.mm));
        entry.distances = values;
        entry.distances_for = distances;
        ++computed_;
    }
    return value_colours(entry, entry.distances, scale);
}

FloatColours DrawCache::field_colours(RestField field, const RestFields::Source& source,
                                      const ColourScale& scale) {
    Object& entry = object(muscles_, source.muscle, source.scene->muscles[source.muscle].mesh);
    return value_colours(entry, rest_fields_.values(field, source), scale);
}

} // namespace fascicle::view
