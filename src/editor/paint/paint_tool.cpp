#include "editor/paint/paint_tool.hpp"

#include "editor/scene_view.hpp"
#include "fascicle/geometry/line_region.hpp"
#include "fascicle/geometry/region_ops.hpp"
#include "view/attachment_marks.hpp"

#include <cmath>
#include <numbers>

namespace fascicle::editor {

namespace {

using Mode = actions::StrokeMode;

constexpr double close_reach_px = 9; ///< a click this near to a point of the line means that point

bool follows_surface(const PaintSettings& settings) {
    return settings.reach != PaintReach::screen;
}

bool is_brush(PaintKind kind) {
    return kind == PaintKind::brush || kind == PaintKind::eraser || kind == PaintKind::smooth;
}

bool same_pose(const Pose& a, const Pose& b) {
    return a.rotation == b.rotation && a.translation == b.translation;
}

/// The muscle's areas on a bone, all labels and heads.
SurfaceRegion all_areas(const Scene& scene, int muscle, int bone, int vertex_count) {
    SurfaceRegion all(vertex_count);
    for (const AttachmentArea& area : scene.muscles[static_cast<std::size_t>(muscle)].areas)
        if (area.bone == bone && area.vertices.vertex_count() == vertex_count)
            all |= area.vertices;
    return all;
}

const char* verb(PaintKind kind, bool erase) {
    if (erase)
        return "Erase";
    switch (kind) {
    case PaintKind::smart_fill:
        return "Smart fill";
    case PaintKind::bucket:
        return "Bucket fill";
    case PaintKind::lasso:
        return "Lasso";
    case PaintKind::line:
        return "Line of";
    default:
        return "";
    }
}

} // namespace

PaintView PaintTool::view_of(const EditorContext& context, const view::ViewSize& size) const {
    PaintView view{context.state.camera, size, {}};
    const ShownFrame shown = context.shown();
    const int bone = paint_.bone(context);
    if (shown.frame != nullptr && bone >= 0 && bone < static_cast<int>(shown.frame->bone_poses.size()))
        view.pose = shown.frame->bone_poses[static_cast<std::size_t>(bone)];
    return view;
}

Mode PaintTool::mode(bool ctrl, bool shift) const {
    const PaintKind kind = paint_.settings.kind;
    if (ctrl || kind == PaintKind::eraser)
        return Mode::erase;
    return (shift && is_brush(kind)) || kind == PaintKind::smooth ? Mode::smooth : Mode::paint;
}

bool PaintTool::take_pointer(EditorContext& context, const PointerInput& input, const view::ViewSize& size) {
    const bool wheel_is_radius = input.inside && input.shift && input.wheel != 0;
    if (wheel_is_radius)
        paint_.settings.scale_radius(std::pow(1.2, input.wheel > 0 ? 1 : -1));
    view_ = view_of(context, size);
    const Vec2 pointer(input.x, input.y);
    if (grip_ == Grip::stroke && !paint_.stroke_open())
        grip_ = Grip::swallow; // undone or given up meanwhile: nothing until the button comes up
    GeodesicSearch* search = paint_.search(context);
    if (search == nullptr || (line_bone_ >= 0 && line_bone_ != paint_.bone(context)))
        cancel(context);
    const SurfacePoint at =
        search == nullptr ? SurfacePoint{} : view_.pick(search->graph(), input.x, input.y);
    switch (grip_) {
    case Grip::stroke:
        step(context, at, pointer);
        hover(context, input, at);
        if (input.released == 0) {
            paint_.finish_stroke();
            grip_ = Grip::none;
        }
        return true;
    case Grip::lasso:
        if ((pointer - lasso_.back()).norm() >= 2)
            lasso_.push_back(pointer);
        if (input.released == 0) {
            apply_lasso(context);
            lasso_.clear();
            grip_ = Grip::none;
        }
        return true;
    case Grip::swallow:
        if (input.released == 0)
            grip_ = Grip::none;
        return true;
    case Grip::none:
        break;
    }
    const bool camera = input.alt || input.camera_held;
    if (input.pressed == 0 && input.inside && !camera && at.triangle >= 0) {
        press(context, input, at);
        return true;
    }
    if (input.inside && !camera && at.triangle >= 0)
        hover(context, input, at);
    else
        forget_hover();
    return wheel_is_radius;
}

void PaintTool::press(EditorContext& context, const PointerInput& input, const SurfacePoint& at) {
    grip_ = Grip::swallow; // the press is ours, whatever comes of it
    if (const std::string why = paint_.blocked(context); !why.empty()) {
        context.log.add(Severity::warning, why + ".");
        return;
    }
    if (context.document.has_uncommitted_edits())
        return;
    const Vec2 pointer(input.x, input.y);
    const PaintSettings& settings = paint_.settings;
    last_pointer_ = pointer;
    stroke_mode_ = mode(input.ctrl, input.shift);
    aim_ = paint_aim(settings, view_, at, pointer, millimetres_per_unit(context.document.scene().unit),
                     double(context.scale()));
    const SurfaceGraph& graph = paint_.search(context)->graph();
    const bool erase = stroke_mode_ == Mode::erase;
    switch (settings.kind) {
    case PaintKind::brush:
    case PaintKind::eraser:
    case PaintKind::smooth:
        if (paint_.begin_stroke(context, stroke_mode_, paint_brush(settings, view_, aim_))) {
            grip_ = Grip::stroke;
            step(context, at, pointer);
        }
        break;
    case PaintKind::smart_fill:
    case PaintKind::bucket: {
        std::vector<int> vertices;
        if (settings.kind == PaintKind::smart_fill) {
            vertices = paint_.fills().smart(graph, at.triangle, settings.crease_deg * std::numbers::pi / 180);
        } else {
            const AttachmentArea* own = paint_.area(context);
            vertices = paint_.fills().bucket(graph, own == nullptr ? nullptr : &own->vertices,
                                             all_areas(context.document.scene(), paint_.muscle(context),
                                                       paint_.bone(context), graph.vertex_count()),
                                             nearest_corner(graph, at), erase);
        }
        if (paint_.begin_stroke(context, stroke_mode_, {}, verb(settings.kind, erase))) {
            grip_ = Grip::stroke;
            touch(context, vertices);
        }
        break;
    }
    case PaintKind::lasso:
        lasso_.assign(1, pointer);
        grip_ = Grip::lasso;
        break;
    case PaintKind::line:
        add_line_point(context, at, pointer, erase);
        break;
    }
}

void PaintTool::step(EditorContext& context, const SurfacePoint& at, const Vec2& pointer) {
    const PaintSettings& settings = paint_.settings;
    if (!is_brush(settings.kind))
        return; // fills are done with the press
    if (follows_surface(settings)) {
        paint_.stroke()->step(at);
    } else if (at.triangle >= 0) {
        const PaintAim aim =
            paint_aim(settings, view_, at, pointer, millimetres_per_unit(context.document.scene().unit),
                      double(context.scale()));
        touch(context,
              under_screen_circle(paint_.search(context)->graph(), settings, view_, last_pointer_, aim));
    }
    last_pointer_ = pointer;
}

void PaintTool::touch(EditorContext& context, const std::vector<int>& vertices) {
    paint_.stroke()->touch(vertices, paint_.stroke_mirrors() ? paint_.mirrored_vertices(context, vertices)
                                                             : std::vector<int>{});
}

void PaintTool::apply_lasso(EditorContext& context) {
    GeodesicSearch* search = paint_.search(context);
    if (search == nullptr || lasso_.size() < 3)
        return;
    const SurfaceRegion region = lasso(search->graph(), view_.matrix(), lasso_,
                                       paint_.settings.through ? LassoReach::through : LassoReach::visible);
    if (!paint_.begin_stroke(context, stroke_mode_, {}, verb(PaintKind::lasso, stroke_mode_ == Mode::erase)))
        return;
    touch(context, region.vertices());
    paint_.finish_stroke();
}

void PaintTool::add_line_point(EditorContext& context, const SurfacePoint& at, const Vec2& pointer,
                               bool erase) {
    GeodesicSearch& search = *paint_.search(context);
    const auto near = [&](const SurfacePoint& anchor) {
        const std::optional<Vec2> place = view_.project(anchor.point);
        return place && (*place - pointer).norm() <= close_reach_px * double(context.scale());
    };
    line_bone_ = paint_.bone(context);
    if (anchors_.size() >= 3 && near(anchors_.front())) {
        lines_.push_back(geodesic_line(search, anchors_.back(), anchors_.front()));
        const std::optional<SurfaceRegion> inside = enclosed_by_lines(search.graph(), lines_);
        apply_line(context,
                   inside ? inside->vertices()
                          : strip_along_lines(search, anchors_, lines_, aim_.radius).vertices(),
                   erase);
        return;
    }
    if (anchors_.size() >= 2 && near(anchors_.back())) { // a double-click ends the line where it is
        finish_line(context);
        return;
    }
    if (!anchors_.empty()) {
        GeodesicLine line = geodesic_line(search, anchors_.back(), at);
        if (line.points.empty()) {
            context.log.add(Severity::warning, "No way along the surface to that point.");
            return;
        }
        lines_.push_back(std::move(line));
    }
    anchors_.push_back(at);
    next_line_ = {};
    hover_.reset();
}

void PaintTool::finish_line(EditorContext& context) {
    GeodesicSearch* search = paint_.search(context);
    if (search == nullptr || anchors_.size() < 2)
        return;
    const PaintAim aim =
        paint_aim(paint_.settings, view_, anchors_.back(), last_pointer_,
                  millimetres_per_unit(context.document.scene().unit), double(context.scale()));
    apply_line(context, strip_along_lines(*search, anchors_, lines_, aim.radius).vertices(),
               stroke_mode_ == Mode::erase);
}

void PaintTool::apply_line(EditorContext& context, const std::vector<int>& vertices, bool erase) {
    if (paint_.begin_stroke(context, erase ? Mode::erase : Mode::paint, {}, verb(PaintKind::line, erase))) {
        touch(context, vertices);
        paint_.finish_stroke();
    }
    anchors_.clear();
    lines_.clear();
    next_line_ = {};
    line_bone_ = -1;
    hover_.reset();
}

void PaintTool::line_back() {
    if (!anchors_.empty())
        anchors_.pop_back();
    if (!lines_.empty())
        lines_.pop_back();
    next_line_ = {};
    hover_.reset();
}

bool PaintTool::cancel(EditorContext& context) {
    static_cast<void>(context);
    const bool line = !anchors_.empty(), drag = grip_ == Grip::stroke || grip_ == Grip::lasso;
    if (drag)
        grip_ = Grip::swallow;
    paint_.cancel_stroke();
    lasso_.clear();
    anchors_.clear();
    lines_.clear();
    next_line_ = {};
    line_bone_ = -1;
    forget_hover();
    return drag || line;
}

void PaintTool::forget_hover() {
    hovering_ = false;
    hover_.reset();
    preview_.clear();
    ring_.clear();
    paint_.set_highlights({});
}

void PaintTool::hover(EditorContext& context, const PointerInput& input, const SurfacePoint& at) {
    GeodesicSearch* search = paint_.search(context);
    hovering_ = search != nullptr && at.triangle >= 0;
    if (!hovering_) {
        forget_hover();
        return;
    }
    const Hover now{input.x,
                    input.y,
                    input.ctrl,
                    input.shift,
                    paint_.settings,
                    context.state.camera.pose(view_.size.aspect()),
                    context.document.version(),
                    view_.pose,
                    &search->graph()};
    if (hover_ && hover_->x == now.x && hover_->y == now.y && hover_->ctrl == now.ctrl &&
        hover_->shift == now.shift && hover_->settings == now.settings &&
        hover_->camera.view == now.camera.view && hover_->camera.projection == now.camera.projection &&
        hover_->version == now.version && same_pose(hover_->pose, now.pose) && hover_->graph == now.graph)
        return;
    hover_ = now;
    aim_ = paint_aim(paint_.settings, view_, at, {input.x, input.y},
                     millimetres_per_unit(context.document.scene().unit), double(context.scale()));
    make_preview(context, input, at);
}

void PaintTool::make_preview(EditorContext& context, const PointerInput& input, const SurfacePoint& at) {
    GeodesicSearch& search = *paint_.search(context);
    const SurfaceGraph& graph = search.graph();
    const PaintSettings& settings = paint_.settings;
    const Mode wanted = paint_.stroke_open() ? stroke_mode_ : mode(input.ctrl, input.shift);
    const Brush brush = paint_brush(settings, view_, aim_);
    ring_.clear();
    if (is_brush(settings.kind) && follows_surface(settings))
        ring_ = cursor_ring(search, at, brush);
    preview_.clear();
    next_line_ = {};
    if (paint_.stroke_open()) { // the stroke itself shows what it does
        paint_.set_highlights({});
        return;
    }
    std::vector<int> touched;
    switch (settings.kind) {
    case PaintKind::brush:
    case PaintKind::eraser:
    case PaintKind::smooth:
        touched = follows_surface(settings) ? brush_vertices(search, at, brush)
                                            : under_screen_circle(graph, settings, view_, aim_.pointer, aim_);
        break;
    case PaintKind::smart_fill:
        touched = paint_.fills().smart(graph, at.triangle, settings.crease_deg * std::numbers::pi / 180);
        break;
    case PaintKind::bucket: {
        const AttachmentArea* own = paint_.area(context);
        touched = paint_.fills().bucket(graph, own == nullptr ? nullptr : &own->vertices,
                                        all_areas(context.document.scene(), paint_.muscle(context),
                                                  paint_.bone(context), graph.vertex_count()),
                                        nearest_corner(graph, at), wanted == Mode::erase);
        break;
    }
    case PaintKind::lasso:
        break;
    case PaintKind::line:
        if (!anchors_.empty())
            next_line_ = geodesic_line(search, anchors_.back(), at);
        break;
    }
    if (!paint_.blocked(context).empty())
        touched.clear();
    const actions::AreaKey key = *paint_.key(context);
    const std::vector<actions::AreaKey> locked = paint_.locked(context);
    preview_ = would_change(context.document.scene(), graph, key, wanted, locked, touched);
    render::Rgba colour = view::attachment_colour(key.kind);
    colour[3] = 0.45f;
    if (wanted != Mode::paint)
        colour = {1.0f, 0.86f, 0.25f, 0.6f};
    std::vector<view::BoneHighlight> highlights{{key.bone, preview_, colour}};
    if (settings.mirror && is_brush(settings.kind) && !touched.empty())
        if (const PaintMirror other = paint_.mirror(context); other.stroke) {
            BoneSurfaces& all = *paint_.surfaces(context);
            const actions::AreaKey& pair = other.stroke->area;
            const MeshPtr& mesh = context.document.scene().bones[static_cast<std::size_t>(pair.bone)].mesh;
            if (pair.bone == key.bone || paint_.has_surface(mesh)) {
                std::vector<int> image;
                if (follows_surface(settings)) { // as the stroke does it: the image of the pointer
                    Brush other_brush = brush;
                    if (brush.eye)
                        other_brush.eye = mirrored(*brush.eye, other.stroke->plane);
                    image = brush_vertices(
                        all.search(mesh),
                        mirror_point(at.point, all.graph(mesh), other.stroke->plane, other.stroke->reach),
                        other_brush);
                } else {
                    image = paint_.mirrored_vertices(context, touched);
                }
                highlights.push_back(
                    {pair.bone,
                     would_change(context.document.scene(), all.graph(mesh), pair, wanted, locked, image),
                     colour});
            }
        }
    paint_.set_highlights(std::move(highlights));
}

} // namespace fascicle::editor
