#pragma once
// The motion being edited: the joint fitted in the background, points picked in the view, a table that was read, and what the
// view shows while a number is dragged. Changes go to the document at once, a step each.

#include "editor/feature.hpp"
#include "editor/viewport_tool.hpp"
#include "fascicle/document/actions/timeline_actions.hpp"
#include "fascicle/geometry/sphere_fit.hpp"
#include "fascicle/io/storage_file.hpp"
#include "view/build_draw_list.hpp"

#include <future>

namespace fascicle::editor {

enum class MotionWay { hinge, keys, file };

/// What a click on a bone is for.
enum class PickFor { nothing, centre, axis_first, axis_second, key_point };

/// The ball that a joint turns in.
struct FittedBall {
    Sphere sphere;
    double rms = 0;      ///< scene units
    double coverage = 0; ///< of the whole sphere
    std::string bone;    ///< that has it
};

/// A named axis: positive angles are positive in the named direction (docs/conventions.md).
struct AnatomicalAxis {
    const char* label;
    Vec3 axis;
};
/// Flexion, abduction and internal rotation of the hip, of both sides, in the scene's axes.
std::vector<AnatomicalAxis> anatomical_axes(view::WorldAxes axes);

class MotionEdit : public Feature, public ViewportTool {
public:
    ~MotionEdit() override;

    MotionWay way = MotionWay::hinge; ///< which part of the panel is open
    std::string key_bone;             ///< whose keys are shown
    int key = -1;                     ///< selected one, or -1

    /// The document's motion about a joint; follows the document.
    const std::optional<actions::HingeMotion>& hinge() const { return hinge_; }
    /// While a control is held; commit() ends it. Errors go to the log.
    void edit(EditorContext& context, const actions::HingeMotion& motion);
    void edit_key(EditorContext& context, int bone, std::size_t index, const actions::Screw& screw);
    /// A key's pose as a screw, told near a point: as it was last edited here, while the key has that pose. A pose forgets the
    /// axis of no turn, and that an angle was negative.
    actions::Screw key_screw(int bone, std::size_t index, const Pose& pose, const Vec3& near) const;
    void commit(EditorContext& context, const std::string& name);
    /// Both at once.
    void set(EditorContext& context, const actions::HingeMotion& motion, const char* name);

    /// Fits the joint's centre to the moving bones in the background, and moves the hinge there when it succeeds.
    void fit(EditorContext& context);
    bool fitting() const { return fit_.valid(); }
    void finish_fit(); ///< waits; for tests
    const std::optional<FittedBall>& ball() const { return ball_; }
    const std::string& fit_problem() const { return fit_problem_; }

    /// The next clicks on bones are points.
    void pick(EditorContext& context, PickFor what);
    PickFor picking() const { return pick_; }
    const std::optional<Vec3>& first_point() const { return first_point_; }

    // A table over time.
    std::shared_ptr<const StorageTable> table;
    int column = -1;
    bool degrees = true;
    bool reversed = false; ///< the column counts against the hinge
    bool from_rest = true; ///< the first row is rest; else frames lead from rest to it
    int lead_in = 20;
    double frames_per_second = 50;
    std::vector<std::string> bone_of_body; ///< of the scene's line muscles, for a motion of all joints
    std::string table_problem;
    void show_table(EditorContext& context, std::shared_ptr<const StorageTable> read);
    void apply_column(EditorContext& context);
    /// All coordinates through the model of the line muscles.
    void apply_model(EditorContext& context);

    /// What the view shows instead of the run while the motion is dragged; null: the run.
    const view::ViewSubject* preview() const { return preview_ ? &*preview_ : nullptr; }

    void update(EditorContext& context) override;
    void document_replaced(EditorContext& context) override;
    std::optional<double> redraw_after() const override;
    bool take_pointer(EditorContext& context, const PointerInput& input, const view::ViewSize& size) override;
    void draw(EditorContext& context, ImDrawList& list, const Rect& area) override;
    bool cancel(EditorContext& context) override;

private:
    struct FitResult {
        std::optional<FittedBall> ball;
        std::string problem;
        std::vector<int> moving;
    };
    void take_fit(EditorContext& context);
    void take_point(EditorContext& context, const Vec3& point);
    void make_preview(const EditorContext& context);

    struct EditedKey {
        int bone = -1;
        std::size_t index = 0;
        Pose pose;
        actions::Screw screw;
    };
    EditedKey edited_key_;
    std::optional<actions::HingeMotion> hinge_;
    std::uint64_t version_ = 0; ///< of the document that hinge_ is of
    std::uint64_t edited_ = 0;  ///< of the document after the last edit here
    std::optional<view::ViewSubject> preview_;
    std::uint64_t preview_version_ = 0;
    int preview_frame_ = -1;
    std::future<FitResult> fit_;
    std::vector<std::future<FitResult>> given_up_;
    std::optional<FittedBall> ball_;
    std::string fit_problem_;
    PickFor pick_ = PickFor::nothing;
    std::optional<Vec3> first_point_;
    bool pressed_on_bone_ = false;
};

/// Whether the motion panel is in front.
bool motion_panel_shown(const EditorContext& context);
/// The hinge and its ball over the view, while the panel is in front.
void draw_motion_overlay(EditorContext& context, ImDrawList& list, const Rect& area);

} // namespace fascicle::editor
