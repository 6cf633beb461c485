#pragma once
// Attachment areas: set at once, or painted stroke by stroke. One undo step each. Indices must be in range.

#include "fascicle/document/document.hpp"
#include "fascicle/geometry/brush.hpp"
#include "fascicle/geometry/region_mirror.hpp"
#include "fascicle/scene/outline_areas.hpp"

namespace fascicle::actions {

/// Which area: of a muscle, on a bone, of a head.
struct AreaKey {
    int muscle = -1;
    AttachmentKind kind = AttachmentKind::origin;
    int bone = -1;
    std::string head = {};
    friend bool operator==(const AreaKey&, const AreaKey&) = default;
};

/// The area, or null when the muscle has none of that key.
const AttachmentArea* find_area(const Scene& scene, const AreaKey& key);

/// Makes the area hold exactly these vertices (of the bone's mesh, FASCICLE_ASSERT); other areas of the muscle on the bone lose them.
/// Empty vertices take the area away. False, and no step, when nothing changes. what: the verb of the step's name, "Grow" gives
/// "Grow origin, iliacus".
bool set_area(Document& document, const AreaKey& key, const SurfaceRegion& vertices,
              const std::string& what = "Set");

/// Takes away all areas of a head, on every bone: one step "Remove head long, biceps". False when it has none.
bool remove_head(Document& document, int muscle, const std::string& head);

/// Lets the muscle's areas count: attachments given vertex by vertex, which come before them, are dropped. False when there are
/// none.
bool drop_fixed_attachments(Document& document, int muscle);

/// The muscle's outlines become its areas, in place of those that it has. Returns how many; 0, and no step, when no outline lies on a bone. Notes and
/// Error as areas_from_outlines; the document is then as it was.
int areas_from_outlines(Document& document, int muscle, BoneSurfaces& surfaces,
                        std::vector<std::string>& notes);

enum class StrokeMode { paint, erase, smooth };

/// The same stroke on the other side of the body.
struct StrokeMirror {
    AreaKey area;
    MirrorPlane plane;
    double reach = 0; ///< how far the other bone may be from the mirror image, scene units
};

struct StrokeOptions {
    StrokeMode mode = StrokeMode::paint;
    Brush brush;
    std::vector<AreaKey> locked; ///< areas (of any muscle) whose vertices a stroke does not change
    std::optional<StrokeMirror> mirror;
    std::string what = {}; ///< the verb of the step's name; empty: that of the mode
};

/// From press to release of the pointer: steps change the scratch alone, finish() makes one undo step named "Paint insertion,
/// gluteus_maximus". Destroyed without finish(), it leaves the document as it was before. The document must have no
/// uncommitted edits at the start (FASCICLE_ASSERT), and nothing else may edit it meanwhile; document and surfaces must outlive the stroke.
class AreaStroke {
public:
    AreaStroke(Document& document, BoneSurfaces& surfaces, AreaKey area, StrokeOptions options);
    ~AreaStroke();
    AreaStroke(const AreaStroke&) = delete;
    AreaStroke& operator=(const AreaStroke&) = delete;

    /// The pointer is over this point of the bone now (triangle == -1: over none, the next step begins anew). Returns the
    /// vertices of the bone that changed in the stroke's own area, ascending: what a label buffer must update.
    const std::vector<int>& step(const SurfacePoint& at);
    /// A step whose vertices another tool has found (a fill, a lasso, a circle on the screen): of the bone, and for the mirrored
    /// area of its own bone (passed over without a mirror). Ascending. Returns as step() does.
    const std::vector<int>& touch(const std::vector<int>& vertices, const std::vector<int>& mirrored = {});
    /// The same for the mirrored area, of the last step; none without a mirror.
    const std::vector<int>& mirrored_changes() const {
        return targets_.back().key == targets_.front().key ? none_ : targets_.back().changed;
    }
    /// False, and no step, when the stroke changed nothing.
    bool finish();
    /// As before the stroke (Esc).
    void cancel();

private:
    struct Target {
        AreaKey key;
        SurfacePoint before; ///< of the last step
        Brush brush;
        std::vector<int> changed;
    };
    std::vector<int> under_brush(Target& target, const SurfacePoint& at);
    void apply(Target& target, std::vector<int> touched);
    const std::vector<int>& joined_changes();
    bool locked(int vertex, int bone) const;

    Document& document_;
    BoneSurfaces& surfaces_;
    StrokeOptions options_;
    std::vector<Target> targets_; ///< the stroke's own, then its mirror image
    std::vector<int> none_;
    bool open_ = true;
};

} // namespace fascicle::actions
