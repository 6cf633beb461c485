#include "editor/scene_view.hpp"

#include "editor/features.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>

namespace fascicle::editor {

namespace {

/// A supersampled picture may cost this much while things move.
constexpr double quick_seconds = 0.012;

double seconds_now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double thread_cpu_seconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

std::size_t count_vertices(const std::vector<std::vector<Attachment>>& lists) {
    std::size_t sum = 0;
    for (const std::vector<Attachment>& list : lists)
        for (const Attachment& attachment : list)
            sum += attachment.vertices.size();
    return sum;
}

} // namespace

view::ViewSubject view_subject(const EditorContext& context) {
    if (context.features.compare.active())
        return context.features.compare.subject();
    if (const view::ViewSubject* preview = context.features.motion.preview())
        return *preview;
    const ShownFrame shown = context.shown();
    view::ViewSubject subject = shown.frame != nullptr
                                    ? view::subject_of(*shown.recording, shown.frame->index)
                                    : view::subject_of(context.document.head());
    // Until the run has its own, or while its are of other parameters: those made beside it.
    if (shown.frame == nullptr || shown.state == FrameState::stale)
        if (std::vector<FibreModelPtr> fibres = context.features.fibres.fibres_for(*subject.scene);
            !fibres.empty())
            subject.fibres = std::move(fibres);
    // Areas are those of the document, also while they are being painted, whatever the run was made with.
    PaintMode& paint = context.features.paint;
    subject.areas = paint.shown_areas(context);
    subject.highlights = paint.highlights();
    subject.marked = paint.marked_vertices(context);
    return subject;
}

view::ViewOptions view_options(const EditorContext& context, const Scene& scene) {
    const EditorState& state = context.state;
    view::ViewOptions options;
    for (const Bone& bone : scene.bones)
        options.hidden_bones.push_back(!state.visible(bone.name));
    for (const Muscle& muscle : scene.muscles)
        options.hidden_muscles.push_back(!state.visible(muscle.name));
    const bool painting = state.tool == Tool::paint;
    options.attachments = state.attachments || painting;
    if (painting)
        options.focus_bone = context.features.paint.bone(context);
    options.colouring = state.colouring;
    options.wireframe = state.wireframe;
    options.rest_ghost = state.rest_ghost;
    options.joint_axis = state.joint_axis;
    options.scales = state.colour_scales;
    options.muscle_opacity = state.muscle_opacity;
    options.bone_opacity = state.bone_opacity;
    options.fibres = state.fibres;
    options.line_muscles = state.line_muscles;
    options.occlusion = state.occlusion;
    options.section = section_plane(state.section);
    if (state.selection.kind == Selection::Kind::bone)
        options.selected_bone = scene.bone_index(state.selection.name);
    if (state.selection.kind == Selection::Kind::muscle)
        options.selected_muscle = scene.muscle_index(state.selection.name);
    context.features.compare.set_options(options);
    return options;
}

SceneView::SceneView(bool best_quality) : best_quality_(best_quality) {
    cache_.rest_fields().set_background(!best_quality);
}

bool SceneView::same(const Key& a, const Key& b) {
    return a.scene == b.scene && a.frame == b.frame && a.attachment_count == b.attachment_count &&
           a.camera.view == b.camera.view && a.camera.projection == b.camera.projection &&
           a.compared == b.compared && a.areas == b.areas && a.highlights == b.highlights &&
           a.marked == b.marked && a.options == b.options && a.fibres == b.fibres && a.dark == b.dark &&
           a.width == b.width && a.height == b.height && a.scale == b.scale;
}

render::DrawList SceneView::build(const EditorContext& context, const view::ViewSubject& subject,
                                  double aspect) {
    const view::ViewOptions options = view_options(context, *subject.scene);
    render::DrawList list =
        view::build_draw_list(subject, options, context.state.camera.pose(aspect), cache_);
    list.background_top = context.theme.view_top;
    list.background_bottom = context.theme.view_bottom;
    return list;
}

unsigned SceneView::texture(const EditorContext& context, int width, int height) {
    return texture(context, view_subject(context), width, height);
}

unsigned SceneView::texture(const EditorContext& context, const view::ViewSubject& subject, int width,
                            int height) {
    const view::ViewOptions options = view_options(context, *subject.scene);
    const double aspect = double(width) / double(height);
    const EditorState& state = context.state;
    const Key key{subject.scene,
                  subject.frame,
                  count_vertices(subject.attachments),
                  subject.areas,
                  subject.highlights,
                  subject.marked,
                  subject.compared,
                  state.camera.pose(aspect),
                  options,
                  state.dark,
                  width,
                  height,
                  state.scale,
                  subject.fibres};
    const bool arrived = cache_.rest_fields().collect();
    const bool unchanged = has_picture_ && !arrived && same(key, key_);
    if (!unchanged)
        changed_ = context.now;
    const bool refine = refinement_pending_ && context.now - changed_ >= refine_after_seconds;
    if (unchanged && !refine)
        return (shows_fine_ ? fine_ : plain_)->texture();

    // While things move a slow machine gets single samples; as soon as they stop, the fine picture.
    const bool fine = best_quality_ || unchanged || fine_seconds_ <= quick_seconds;
    auto& target = fine ? fine_ : plain_;
    if (target == nullptr || target->width() != width || target->height() != height)
        target = std::make_unique<render::OffscreenTarget>(width, height, fine ? 2 : 1);
    render::DrawList list = build(context, subject, aspect);
    if (!fine) // shade from the neighbourhood is for the refined picture
        list.occlusion_radius = 0;
    const double start = seconds_now(), cpu = thread_cpu_seconds();
    renderer_.draw(list, *target, state.scale * static_cast<float>(target->supersampling()));
    raster_seconds_ += thread_cpu_seconds() - cpu;
    if (fine && has_picture_) // the first one also compiles and uploads
        fine_seconds_ = std::max(seconds_now() - start, fine_seconds_ * 0.9);
    key_ = key;
    has_picture_ = true;
    shows_fine_ = fine;
    refinement_pending_ = !fine;
    ++drawn_;
    return target->texture();
}

render::Image SceneView::image_of(const EditorContext& context, const view::ViewSubject& subject, int width,
                                  int height) {
    const render::OffscreenTarget target(width, height, 2);
    const float scale = context.state.scale * 2;
    cache_.rest_fields().set_background(false); // a picture in a file waits for its colours
    renderer_.draw(build(context, subject, double(width) / double(height)), target, scale);
    cache_.rest_fields().set_background(!best_quality_);
    return target.read_back();
}

render::Image SceneView::picture(const EditorContext& context, int width, int height) {
    const Compare& compare = context.features.compare;
    if (!compare.active(CompareMode::side_by_side) || width < 2)
        return image_of(context, view_subject(context), width, height);
    const int left = width / 2;
    const render::Image parts[] = {image_of(context, compare.subject(), left, height),
                                   image_of(context, compare.subject(true), width - left, height)};
    render::Image image{width, height, {}};
    image.rgba.reserve(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (int y = 0; y < height; ++y)
        for (const render::Image& part : parts) {
            const auto row = part.rgba.begin() + std::ptrdiff_t{4} * part.width * y;
            image.rgba.insert(image.rgba.end(), row, row + std::ptrdiff_t{4} * part.width);
        }
    return image;
}

} // namespace fascicle::editor
