#pragma once
// How the paint tools are set. View state: never undone, never saved with the scene.

#include "editor/key_bindings.hpp"
#include "editor/widgets/icons.hpp"
#include "fascicle/anatomy/attachment.hpp"

#include <span>
#include <string>

namespace fascicle::editor {

enum class PaintKind { brush, eraser, smooth, smart_fill, bucket, lasso, line };

struct PaintKindRow {
    PaintKind kind;
    const char* id;
    Icon icon;
    Command command;
};
/// In the order of PaintKind, which is that of the keys 1 to 7.
std::span<const PaintKindRow> paint_kinds();

/// How far a brush reaches: along the surface from the pointer, in a straight line, or as a circle on the screen.
enum class PaintReach { connected, sphere, screen };

struct PaintSettings {
    PaintKind kind = PaintKind::brush;
    PaintKind before_eraser = PaintKind::brush; ///< where E goes back to
    AttachmentKind label = AttachmentKind::insertion;
    std::string head; ///< of a muscle with several; empty: the only one
    double radius_mm = 8;
    double radius_px = 40; ///< at scale 1
    bool pixels = false;   ///< the radius stays the same on the screen
    PaintReach reach = PaintReach::connected;
    bool through = false; ///< a circle or lasso on the screen also takes what the bone hides
    double crease_deg = 30;
    bool mirror = false;
    bool lock_origin = false, lock_insertion = false;
    bool show_fixed = true; ///< dots on the muscle vertices that the area will fix
    bool operator==(const PaintSettings&) const = default;

    static constexpr double smallest_mm = 0.2, largest_mm = 100;
    static constexpr double smallest_px = 4, largest_px = 400;
    bool& lock(AttachmentKind kind_of_label) {
        return kind_of_label == AttachmentKind::origin ? lock_origin : lock_insertion;
    }
    bool locked(AttachmentKind kind_of_label) const {
        return kind_of_label == AttachmentKind::origin ? lock_origin : lock_insertion;
    }
    void choose(PaintKind wanted);
    /// Times the factor, within limits.
    void scale_radius(double factor);
    /// "8.0 mm" or "40 px".
    std::string radius_text() const;
};

} // namespace fascicle::editor
