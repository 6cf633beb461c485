#include "editor/paint/paint_mode.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/geometry/region_ops.hpp"

#include <algorithm>

namespace fascicle::editor {

namespace {

std::size_t z(int i) {
    return static_cast<std::size_t>(i);
}

/// A bone that the muscle is attached to, -1 for none: where the insertion is, else the first.
int attached_bone(const Scene& scene, const Muscle& muscle) {
    int bone = -1;
    const auto offer = [&](AttachmentKind kind, int b) {
        if (b >= 0 && b < static_cast<int>(scene.bones.size()) &&
            (bone < 0 || kind == AttachmentKind::insertion))
            bone = b;
    };
    for (const AttachmentArea& area : muscle.areas)
        offer(area.kind, area.bone);
    if (bone < 0)
        for (const Attachment& attachment : muscle.attachments)
            offer(attachment.kind, attachment.bone);
    if (bone < 0)
        for (const AttachmentOutline& outline : muscle.outlines)
            offer(outline.kind, scene.bone_index(outline.bone));
    return bone;
}

const char* verb(AreaOperation operation) {
    switch (operation) {
    case AreaOperation::keep_largest:
        return "Keep the largest island of";
    case AreaOperation::fill_holes:
        return "Fill holes of";
    case AreaOperation::invert:
        return "Invert";
    case AreaOperation::clear:
        return "Clear";
    case AreaOperation::grow:
        return "Grow";
    case AreaOperation::shrink:
        return "Shrink";
    }
    return "";
}

} // namespace

CommandState PaintMode::can_enter(const EditorContext& context) const {
    const Scene& scene = context.document.scene();
    const Selection& selection = context.state.selection;
    if (scene.muscles.empty())
        return {false, false, "the scene has no muscle to paint for"};
    if (selection.kind == Selection::Kind::bone && scene.bone_index(selection.name) >= 0)
        return {};
    const int m = selection.kind == Selection::Kind::muscle ? scene.muscle_index(selection.name) : -1;
    if (m >= 0 && attached_bone(scene, scene.muscles[z(m)]) >= 0)
        return {};
    return {false, false, "select the bone to paint on"};
}

void PaintMode::enter(EditorContext& context) {
    if (!can_enter(context).enabled)
        return;
    const Scene& scene = context.document.scene();
    EditorState& state = context.state;
    if (state.selection.kind == Selection::Kind::muscle) {
        muscle_ = state.selection.name;
        bone_ = scene.bones[z(attached_bone(scene, scene.muscles[z(scene.muscle_index(muscle_))]))].name;
        state.selection = {Selection::Kind::bone, bone_};
    } else {
        bone_ = state.selection.name;
        if (scene.muscle_index(muscle_) < 0) {
            muscle_ = scene.muscles.front().name;
            for (auto it = scene.muscles.rbegin(); it != scene.muscles.rend(); ++it)
                if (attached_bone(scene, *it) ==
                    scene.bone_index(bone_)) // the first whose insertion is there
                    muscle_ = it->name;
        }
    }
    followed_ = state.selection;
    state.hidden.erase(bone_);
    state.tool = Tool::paint;
    if (state.side_panel != "paint")
        side_panel_before_ = state.side_panel;
    state.side_panel = "paint";
    state.layout.show_right = true;
    active_ = true;
    surfaces_.want({scene.bones[z(scene.bone_index(bone_))].mesh});
}

void PaintMode::leave(EditorContext& context) {
    cancel_stroke();
    context.state.tool = Tool::look;
    if (active_ && context.state.side_panel == "paint" && !side_panel_before_.empty())
        context.state.side_panel = side_panel_before_;
    active_ = false;
    highlights_ = nullptr;
    fixed_.forget();
}

int PaintMode::bone(const EditorContext& context) const {
    return active_ ? context.document.scene().bone_index(bone_) : -1;
}

int PaintMode::muscle(const EditorContext& context) const {
    return active_ ? context.document.scene().muscle_index(muscle_) : -1;
}

void PaintMode::set_muscle(const EditorContext& context, int muscle) {
    muscle_ = context.document.scene().muscles[z(muscle)].name;
    settings.head.clear();
    fills_.forget();
}

void PaintMode::set_bone(EditorContext& context, int bone) {
    bone_ = context.document.scene().bones[z(bone)].name;
    context.state.selection = followed_ = {Selection::Kind::bone, bone_};
    context.state.hidden.erase(bone_);
    fills_.forget();
}

std::optional<actions::AreaKey> PaintMode::key(const EditorContext& context) const {
    const int b = bone(context), m = muscle(context);
    if (b < 0 || m < 0)
        return std::nullopt;
    return actions::AreaKey{m, settings.label, b, settings.head};
}

const AttachmentArea* PaintMode::area(const EditorContext& context) const {
    const std::optional<actions::AreaKey> wanted = key(context);
    return wanted ? actions::find_area(context.document.scene(), *wanted) : nullptr;
}

std::vector<std::string> PaintMode::heads(const EditorContext& context) const {
    std::vector<std::string> names{""};
    const int m = muscle(context);
    if (m < 0)
        return names;
    const auto add = [&](const std::string& name) {
        if (std::find(names.begin(), names.end(), name) == names.end())
            names.push_back(name);
    };
    const Muscle& own = context.document.scene().muscles[z(m)];
    for (const AttachmentArea& one : own.areas)
        add(one.head);
    for (const AttachmentOutline& outline : own.outlines)
        add(outline.head);
    if (const auto added = added_heads_.find(muscle_); added != added_heads_.end())
        for (const std::string& name : added->second)
            add(name);
    return names;
}

void PaintMode::add_head(const EditorContext& context, const std::string& head) {
    if (head.empty() || muscle(context) < 0)
        return;
    added_heads_[muscle_].push_back(head);
    settings.head = head;
}

void PaintMode::remove_head(EditorContext& context, const std::string& head) {
    const int m = muscle(context);
    if (m < 0 || stroke_open())
        return;
    if (!head.empty())
        std::erase(added_heads_[muscle_], head);
    actions::remove_head(context.document, m, head);
    if (settings.head == head)
        settings.head.clear();
}

BoneSurfaces* PaintMode::surfaces(const EditorContext& context) {
    const int b = bone(context);
    return b < 0 ? nullptr : surfaces_.ready(context.document.scene().bones[z(b)].mesh);
}

GeodesicSearch* PaintMode::search(const EditorContext& context) {
    BoneSurfaces* all = surfaces(context);
    return all == nullptr ? nullptr : &all->search(context.document.scene().bones[z(bone(context))].mesh);
}

std::string PaintMode::blocked(const EditorContext& context) const {
    if (!key(context))
        return "Nothing to paint on";
    if (surfaces_.busy())
        return "Preparing the surface of " + bone_;
    if (!context.state.visible(bone_))
        return bone_ + " is hidden";
    if (settings.locked(settings.label))
        return std::string(settings.label == AttachmentKind::origin ? "Origin" : "Insertion") + " is locked";
    return {};
}

PaintMirror PaintMode::mirror(const EditorContext& context) const {
    const std::optional<actions::AreaKey> own = key(context);
    return own ? find_mirror(context.document.scene(), *own, context.state.camera.axes()) : PaintMirror{};
}

std::vector<actions::AreaKey> PaintMode::locked(const EditorContext& context) const {
    std::vector<actions::AreaKey> keys;
    const int own = muscle(context);
    if (own < 0)
        return keys;
    const Scene& scene = context.document.scene();
    const std::string pair = other_side(muscle_);
    for (const int m : {own, pair.empty() ? -1 : scene.muscle_index(pair)})
        if (m >= 0)
            for (const AttachmentArea& one : scene.muscles[z(m)].areas)
                if (one.kind != AttachmentKind::unknown && settings.locked(one.kind))
                    keys.push_back({m, one.kind, one.bone, one.head});
    return keys;
}

bool PaintMode::begin_stroke(EditorContext& context, actions::StrokeMode mode, const Brush& brush,
                             const std::string& what) {
    BoneSurfaces* all = surfaces(context);
    if (all == nullptr || stroke_open() || !blocked(context).empty() ||
        context.document.has_uncommitted_edits())
        return false;
    actions::StrokeOptions options;
    options.mode = mode;
    options.brush = brush;
    options.locked = locked(context);
    options.what = what;
    if (settings.mirror)
        if (const PaintMirror other = mirror(context); other.stroke) {
            const MeshPtr& mesh = context.document.scene().bones[z(other.stroke->area.bone)].mesh;
            if (surfaces_.ready(mesh) != nullptr)
                options.mirror = other.stroke;
        }
    stroke_mirrors_ = options.mirror.has_value();
    context.state.playback.playing = false; // the bone holds still under the brush
    stroke_document_ = &context.document;
    stroke_ =
        std::make_unique<actions::AreaStroke>(context.document, *all, *key(context), std::move(options));
    return true;
}

std::vector<int> PaintMode::mirrored_vertices(const EditorContext& context,
                                              const std::vector<int>& vertices) {
    const std::optional<actions::AreaKey> own = key(context);
    const PaintMirror other = mirror(context);
    BoneSurfaces* all = surfaces(context);
    if (!own || !other.stroke || all == nullptr)
        return {};
    const Scene& scene = context.document.scene();
    const SurfaceGraph& from = all->graph(scene.bones[z(own->bone)].mesh);
    const SurfaceGraph& to = all->graph(scene.bones[z(other.stroke->area.bone)].mesh);
    return mirror_region(from, SurfaceRegion(from.vertex_count(), vertices), to, other.stroke->plane,
                         other.stroke->reach)
        .vertices();
}

void PaintMode::finish_stroke() {
    if (stroke_ != nullptr)
        stroke_->finish();
    stroke_ = nullptr;
}

void PaintMode::cancel_stroke() {
    if (stroke_ != nullptr)
        stroke_->cancel();
    stroke_ = nullptr;
}

SurfaceRegion PaintMode::without_locked(const EditorContext& context, const SurfaceRegion& region) const {
    SurfaceRegion result = region;
    const int b = bone(context);
    for (const actions::AreaKey& lock : locked(context))
        if (lock.bone == b)
            if (const AttachmentArea* one = actions::find_area(context.document.scene(), lock);
                one != nullptr && one->vertices.vertex_count() == region.vertex_count())
                result -= one->vertices;
    return result;
}

CommandState PaintMode::can_apply(const EditorContext& context, AreaOperation operation) const {
    if (context.state.tool != Tool::paint)
        return {false, false, "only while painting"};
    if (const std::string why = blocked(context); !why.empty())
        return {false, false, why};
    const AttachmentArea* own = area(context);
    if (own == nullptr && operation != AreaOperation::invert)
        return {false, false, "nothing is painted yet"};
    if (operation == AreaOperation::keep_largest && measure_.numbers().region.islands < 2)
        return {false, false, "there is one island alone"};
    if (operation == AreaOperation::fill_holes && measure_.numbers().region.holes == 0)
        return {false, false, "there is no hole"};
    return {};
}

void PaintMode::apply(EditorContext& context, AreaOperation operation) {
    GeodesicSearch* tools = search(context);
    if (tools == nullptr || stroke_open() || !can_apply(context, operation).enabled ||
        context.document.has_uncommitted_edits())
        return;
    const SurfaceGraph& graph = tools->graph();
    const AttachmentArea* own = area(context);
    const SurfaceRegion before = own != nullptr && own->vertices.vertex_count() == graph.vertex_count()
                                     ? own->vertices
                                     : SurfaceRegion(graph.vertex_count());
    SurfaceRegion after = before;
    switch (operation) {
    case AreaOperation::keep_largest:
        after = keep_largest(graph, before);
        break;
    case AreaOperation::fill_holes:
        after = fill_holes(graph, before);
        break;
    case AreaOperation::invert:
        after = before.complement();
        break;
    case AreaOperation::clear:
        after = SurfaceRegion(graph.vertex_count());
        break;
    case AreaOperation::grow:
        after = grow_ring(graph, before);
        break;
    case AreaOperation::shrink:
        after = shrink_ring(graph, before);
        break;
    }
    after = without_locked(context, after);
    const bool unlike = !(after == before);
    if (unlike)
        actions::set_area(context.document, *key(context), after, verb(operation));
}

void PaintMode::from_outlines(EditorContext& context) {
    BoneSurfaces* all = surfaces(context);
    const int m = muscle(context);
    if (all == nullptr || m < 0 || stroke_open() || context.document.has_uncommitted_edits())
        return;
    std::vector<std::string> notes;
    try {
        if (actions::areas_from_outlines(context.document, m, *all, notes) == 0)
            notes.push_back(muscle_ + ": no outline lies on a bone");
    } catch (const Error& error) {
        context.log.add(Severity::error, error.what());
    }
    for (const std::string& note : notes)
        context.log.add(Severity::note, note);
}

double PaintMode::size_of(const EditorContext& context, const AttachmentArea& one) {
    const Scene& scene = context.document.scene();
    if (one.bone < 0 || one.bone >= static_cast<int>(scene.bones.size()))
        return 0;
    const TriMesh& mesh = *scene.bones[z(one.bone)].mesh;
    if (one.vertices.vertex_count() != mesh.vertex_count())
        return 0;
    for (const Size& known : sizes_)
        if (known.mesh == &mesh && known.vertices == one.vertices)
            return known.size;
    double sum = 0;
    for (const Tri& t : mesh.triangles) {
        const int inside = int(one.vertices.contains(t[0])) + int(one.vertices.contains(t[1])) +
                           int(one.vertices.contains(t[2]));
        if (inside > 0)
            sum += inside *
                   (mesh.positions[z(t[1])] - mesh.positions[z(t[0])])
                       .cross(mesh.positions[z(t[2])] - mesh.positions[z(t[0])])
                       .norm() /
                   6;
    }
    if (sizes_.size() > 64)
        sizes_.clear();
    sizes_.push_back({&mesh, one.vertices, sum});
    return sum;
}

view::ShownAreas PaintMode::shown_areas(const EditorContext& context) {
    const int on_top = muscle(context);
    const std::uint64_t version = context.document.version();
    if (shown_ == nullptr || shown_version_ != version || shown_on_top_ != on_top) {
        std::vector<std::vector<AttachmentArea>> by_muscle;
        for (const Muscle& one : context.document.scene().muscles)
            by_muscle.push_back(one.areas);
        view::ShownAreas fresh = view::shown_areas(by_muscle, on_top);
        if (shown_ == nullptr || *fresh != *shown_) // a parameter's change makes no new picture
            shown_ = std::move(fresh);
        shown_version_ = version;
        shown_on_top_ = on_top;
    }
    return shown_;
}

std::shared_ptr<const view::ViewSubject::MarkedVertices>
PaintMode::marked_vertices(const EditorContext& context) {
    const int m = muscle(context);
    if (m < 0 || !settings.show_fixed || fixed_.vertices() == nullptr)
        return nullptr;
    if (marked_ == nullptr || marked_from_ != fixed_.vertices() || marked_->muscle != m) {
        marked_from_ = fixed_.vertices();
        marked_ = std::make_shared<const view::ViewSubject::MarkedVertices>(
            view::ViewSubject::MarkedVertices{m, *marked_from_});
    }
    return marked_;
}

void PaintMode::set_highlights(std::vector<view::BoneHighlight> highlights) {
    std::erase_if(highlights, [](const view::BoneHighlight& one) { return one.vertices.empty(); });
    const auto same = [](const view::BoneHighlight& a, const view::BoneHighlight& b) {
        return a.bone == b.bone && a.colour == b.colour && a.vertices == b.vertices;
    };
    const std::size_t count = highlights_ == nullptr ? 0 : highlights_->size();
    if (count == highlights.size() &&
        (count == 0 || std::equal(highlights.begin(), highlights.end(), highlights_->begin(), same)))
        return;
    highlights_ = highlights.empty()
                      ? nullptr
                      : std::make_shared<const std::vector<view::BoneHighlight>>(std::move(highlights));
}

void PaintMode::finish(EditorContext& context) {
    surfaces_.finish();
    update(context);
    fixed_.finish();
}

void PaintMode::update(EditorContext& context) {
    surfaces_.update();
    fixed_.update();
    if (stroke_ != nullptr && context.state.tool != Tool::paint)
        cancel_stroke();
    if (context.state.tool != Tool::paint) {
        if (active_)
            leave(context);
        return;
    }
    const Scene& scene = context.document.scene();
    const Selection& selection = context.state.selection;
    if (!active_ || selection != followed_) { // the tree was clicked, or a name changed
        if (selection.kind == Selection::Kind::bone && scene.bone_index(selection.name) >= 0)
            bone_ = selection.name;
        else if (selection.kind == Selection::Kind::muscle && scene.muscle_index(selection.name) >= 0 &&
                 selection.name != muscle_)
            set_muscle(context, scene.muscle_index(selection.name));
        followed_ = selection;
        active_ = true;
        fills_.forget();
    }
    const int b = bone(context), m = muscle(context);
    if (b < 0 || m < 0) { // removed, or undone
        leave(context);
        return;
    }
    if (stroke_open() && surfaces(context) == nullptr)
        cancel_stroke();
    std::vector<MeshPtr> needed{scene.bones[z(b)].mesh};
    if (settings.mirror)
        if (const PaintMirror other = mirror(context); other.stroke)
            needed.push_back(scene.bones[z(other.stroke->area.bone)].mesh);
    if (!stroke_open())
        surfaces_.want(needed);
    if (surfaces_.busy())
        return;
    const SurfaceGraph& graph = surfaces_.ready(needed.front())->graph(needed.front());
    const AttachmentArea* own = area(context);
    measure_.follow(graph, own == nullptr ? nullptr : &own->vertices, stroke_open(), context.now);
    if (settings.show_fixed && !stroke_open())
        fixed_.follow(scene.muscles[z(m)].mesh, graph, own == nullptr ? nullptr : &own->vertices,
                      millimetres_per_unit(scene.unit));
}

void PaintMode::document_replaced(EditorContext& context) {
    stroke_ = nullptr;
    leave(context);
    bone_.clear();
    muscle_.clear();
    added_heads_.clear();
    settings.head.clear();
    measure_.forget();
    fills_.forget();
    surfaces_.forget();
    sizes_.clear();
    shown_ = nullptr;
    marked_ = nullptr;
}

std::optional<double> PaintMode::redraw_after() const {
    if (surfaces_.busy() || fixed_.busy())
        return 1.0 / 25;
    if (measure_.late())
        return 0.25;
    return std::nullopt;
}

} // namespace fascicle::editor
