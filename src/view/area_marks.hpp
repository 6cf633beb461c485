#pragma once
// Attachment areas on bones: the colour of every vertex of a bone, and the borders of the areas on it. Follows changes of the
// areas vertex by vertex, so that a stroke of a brush costs what it touches and not what the bone holds.

#include "fascicle/anatomy/attachment_area.hpp"
#include "fascicle/geometry/tri_mesh.hpp"
#include "render/draw_list.hpp"

#include <memory>
#include <unordered_set>
#include <vector>

namespace fascicle::view {

/// An area as it is shown. faint: of a muscle that is not the one being worked on.
struct ShownArea {
    int muscle = -1;
    AttachmentArea area;
    bool faint = false;
    bool operator==(const ShownArea&) const = default;
};
/// In the order in which they lie over each other, the last on top.
using ShownAreas = std::shared_ptr<const std::vector<ShownArea>>;

/// Vertices of a bone that would change: mixed with a colour.
struct BoneHighlight {
    int bone = -1;
    std::vector<int> vertices;
    render::Rgba colour{1, 1, 1, 0.6f}; ///< alpha: how much of it
};

/// Of one bone. Not thread-safe.
class AreaMarks {
public:
    explicit AreaMarks(MeshPtr mesh);

    /// Brings colours and borders up to the areas (those of this bone that fit its mesh) and highlights.
    void update(int bone, const std::vector<ShownArea>& areas, const std::vector<BoneHighlight>& highlights,
                const render::Rgba& base);

    const MeshPtr& mesh() const { return mesh_; }
    bool any() const { return !layers_.empty() || !highlighted_.empty(); }
    const std::shared_ptr<const render::LiveColours>& colours() const { return shown_colours_; }
    /// Segments, two points each, with their colours: origins solid, insertions dashed, others dotted.
    const std::shared_ptr<const std::vector<render::Vec3f>>& border_points() const { return points_; }
    const std::shared_ptr<const std::vector<render::Rgba>>& border_colours() const { return point_colours_; }

private:
    struct Layer {
        ShownArea shown;
        std::unordered_set<int> mixed; ///< triangles with corners inside and outside
        std::vector<std::vector<render::Vec3f>>
            lines; ///< its border, each closed unless it ends at an open rim
        std::vector<char> closed;
    };
    void update_mixed(Layer& layer, const std::vector<int>& changed);
    void chain(Layer& layer) const;
    void draw_borders();
    void recolour(std::vector<int> vertices);
    render::Rgba colour_of(int vertex) const;

    MeshPtr mesh_;
    std::vector<int> starts_, around_; ///< triangles around each vertex
    std::vector<Layer> layers_;
    std::vector<int> highlighted_; ///< ascending
    render::Rgba highlight_colour_{}, base_{};
    double dash_ = 0; ///< scene units
    std::shared_ptr<render::LiveColours> colours_;
    std::shared_ptr<const render::LiveColours> shown_colours_;
    std::shared_ptr<const std::vector<render::Vec3f>> points_;
    std::shared_ptr<const std::vector<render::Rgba>> point_colours_;
};

/// The areas of a scene, in its order.
ShownAreas shown_areas(const std::vector<std::vector<AttachmentArea>>& by_muscle, int on_top = -1);

} // namespace fascicle::view
