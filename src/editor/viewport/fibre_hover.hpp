#pragma once
// The fibre under the pointer, and the one that a plot or the view points at, drawn bright over the picture.

#include "editor/feature.hpp"

namespace fascicle::editor {

/// Places of the fibres are kept from frame to frame: nothing is computed while neither frame nor camera changes, and nothing
/// allocated while the fibres stay the same.
class FibreHover : public Feature {
public:
    /// How near the pointer has to be, pixels at scale 1.
    static constexpr double reach_px = 6;

    /// pointer: pixels of the view. Sets next_hover_fibre to the nearest fibre in reach, of those that are drawn.
    void point_at(EditorContext& context, const Vec2& pointer, const view::ViewSize& size);
    /// The state's hover_fibre, with its length when the pointer is at it.
    void draw(EditorContext& context, ImDrawList& list, const Rect& area);
    void document_replaced(EditorContext& context) override;

    /// Times that places in space and on the screen were computed, for tests.
    int carried() const { return carried_; }
    int projected() const { return projected_; }

private:
    struct Lines {
        FibreModelPtr model;
        PointsPtr surface; ///< that `points` follow
        Points points;
        std::vector<ImVec2>
            places; ///< in the view; x is NaN behind the eye and where a section took the point away
        std::uint64_t places_for = 0;
    };
    /// All that the way from space to the screen depends on.
    struct Lens {
        Vec3 eye, right, up, backward;
        double units_per_pixel = 1, distance = 1, width = 1, height = 1;
        bool orthographic = false;
        std::optional<view::SectionPlane> section;
        bool operator==(const Lens& other) const;
    };
    void use_lens(const EditorContext& context, const view::ViewSize& size);
    /// Of a muscle of the shown scene, brought up to date; null when it has no fibres.
    Lines* lines(const EditorContext& context, const ShownFrame& shown, std::size_t muscle);

    Recording* models_of_ = nullptr; ///< only compared
    std::vector<FibreModelPtr> models_;
    std::vector<Lines> lines_; ///< by muscle
    Lens lens_;
    std::uint64_t lens_number_ = 0;
    std::vector<ImVec2> strip_;       ///< of draw()
    std::optional<Vec2> pointer_;     ///< of this frame
    std::optional<FibreRef> pointed_; ///< what the pointer was at in the frame before
    std::optional<FibreRef> points_at_;
    int carried_ = 0, projected_ = 0;
};

} // namespace fascicle::editor
