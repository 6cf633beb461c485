#include "fascicle/document/actions/area_actions.hpp"

#include "fascicle/geometry/region_ops.hpp"

#include <algorithm>
#include <utility>

namespace fascicle::actions {

namespace {

constexpr int smoothing_passes = 4;

Muscle& muscle_of(Scene& scene, const AreaKey& key) {
    FASCICLE_ASSERT(key.muscle >= 0 && key.muscle < static_cast<int>(scene.muscles.size()));
    FASCICLE_ASSERT(key.bone >= 0 && key.bone < static_cast<int>(scene.bones.size()));
    return scene.muscles[static_cast<std::size_t>(key.muscle)];
}

const MeshPtr& bone_mesh(const Scene& scene, int bone) {
    FASCICLE_ASSERT(bone >= 0 && bone < static_cast<int>(scene.bones.size()));
    return scene.bones[static_cast<std::size_t>(bone)].mesh;
}

/// Index of the area, made when it is not there. One that was made for another mesh starts anew.
std::size_t area_index(Scene& scene, const AreaKey& key) {
    std::vector<AttachmentArea>& areas = muscle_of(scene, key).areas;
    int at = fascicle::find_area(areas, key.kind, key.bone, key.head);
    if (at < 0) {
        at = static_cast<int>(areas.size());
        areas.push_back({key.kind, key.bone, key.head, {}});
    }
    SurfaceRegion& vertices = areas[static_cast<std::size_t>(at)].vertices;
    if (const int count = bone_mesh(scene, key.bone)->vertex_count(); vertices.vertex_count() != count)
        vertices = SurfaceRegion(count);
    return static_cast<std::size_t>(at);
}

std::string step_name(const Scene& scene, const std::string& what, const AreaKey& key) {
    return what + " " + to_text(key.kind) + (key.head.empty() ? "" : " of " + key.head) + ", " +
           scene.muscles[static_cast<std::size_t>(key.muscle)].name;
}

void drop_empty(Muscle& muscle) {
    std::erase_if(muscle.areas, [](const AttachmentArea& area) { return area.vertices.empty(); });
}

bool same_areas(const Scene& a, const Scene& b) {
    for (std::size_t m = 0; m < a.muscles.size(); ++m)
        if (!(a.muscles[m].areas == b.muscles[m].areas))
            return false;
    return true;
}

const char* verb(StrokeMode mode) {
    return mode == StrokeMode::paint ? "Paint" : mode == StrokeMode::erase ? "Erase" : "Smooth";
}

} // namespace

const AttachmentArea* find_area(const Scene& scene, const AreaKey& key) {
    if (key.muscle < 0 || key.muscle >= static_cast<int>(scene.muscles.size()))
        return nullptr;
    const std::vector<AttachmentArea>& areas = scene.muscles[static_cast<std::size_t>(key.muscle)].areas;
    const int at = fascicle::find_area(areas, key.kind, key.bone, key.head);
    return at < 0 ? nullptr : &areas[static_cast<std::size_t>(at)];
}

bool set_area(Document& document, const AreaKey& key, const SurfaceRegion& vertices,
              const std::string& what) {
    FASCICLE_ASSERT(vertices.vertex_count() == bone_mesh(document.scene(), key.bone)->vertex_count());
    const AttachmentArea* area = find_area(document.scene(), key);
    if (area == nullptr ? vertices.empty() : area->vertices == vertices)
        return false;
    Scene& scene = document.edit();
    const std::size_t at = area_index(scene, key);
    Muscle& muscle = muscle_of(scene, key);
    muscle.areas[at].vertices = vertices;
    give_vertices(muscle.areas, at);
    drop_empty(muscle);
    return document.commit(step_name(scene, what, key));
}

bool remove_head(Document& document, int muscle, const std::string& head) {
    FASCICLE_ASSERT(muscle >= 0 && muscle < static_cast<int>(document.scene().muscles.size()));
    const auto m = static_cast<std::size_t>(muscle);
    const auto of_head = [&](const AttachmentArea& area) { return area.head == head; };
    const std::vector<AttachmentArea>& areas = document.scene().muscles[m].areas;
    if (std::none_of(areas.begin(), areas.end(), of_head))
        return false;
    Scene& scene = document.edit();
    std::erase_if(scene.muscles[m].areas, of_head);
    return document.commit("Remove head" + (head.empty() ? "" : " " + head) + ", " + scene.muscles[m].name);
}

bool drop_fixed_attachments(Document& document, int muscle) {
    FASCICLE_ASSERT(muscle >= 0 && muscle < static_cast<int>(document.scene().muscles.size()));
    const auto m = static_cast<std::size_t>(muscle);
    if (document.scene().muscles[m].attachments.empty())
        return false;
    Scene& scene = document.edit();
    scene.muscles[m].attachments.clear();
    return document.commit("Use areas, " + scene.muscles[m].name);
}

int areas_from_outlines(Document& document, int muscle, BoneSurfaces& surfaces,
                        std::vector<std::string>& notes) {
    FASCICLE_ASSERT(muscle >= 0 && muscle < static_cast<int>(document.scene().muscles.size()));
    const auto m = static_cast<std::size_t>(muscle);
    std::vector<AttachmentArea> areas =
        fascicle::areas_from_outlines(document.scene(), document.scene().muscles[m], surfaces, notes);
    const int count = static_cast<int>(areas.size());
    if (count == 0 || areas == document.scene().muscles[m].areas)
        return count;
    Scene& scene = document.edit();
    scene.muscles[m].areas = std::move(areas);
    document.commit("Areas from outlines, " + scene.muscles[m].name);
    return count;
}

AreaStroke::AreaStroke(Document& document, BoneSurfaces& surfaces, AreaKey area, StrokeOptions options)
    : document_(document), surfaces_(surfaces), options_(std::move(options)) {
    FASCICLE_ASSERT(!document.has_uncommitted_edits());
    targets_.push_back({std::move(area), {}, options_.brush, {}});
    if (options_.mirror) {
        targets_.push_back({options_.mirror->area, {}, options_.brush, {}});
        if (options_.brush.eye)
            targets_.back().brush.eye = mirrored(*options_.brush.eye, options_.mirror->plane);
    }
}

AreaStroke::~AreaStroke() {
    cancel();
}

bool AreaStroke::locked(int vertex, int bone) const {
    for (const AreaKey& key : options_.locked) {
        const AttachmentArea* area = key.bone == bone ? find_area(document_.scene(), key) : nullptr;
        if (area != nullptr && vertex < area->vertices.vertex_count() && area->vertices.contains(vertex))
            return true;
    }
    return false;
}

std::vector<int> AreaStroke::under_brush(Target& target, const SurfacePoint& at) {
    const SurfacePoint before = std::exchange(target.before, at);
    if (at.triangle < 0)
        return {};
    GeodesicSearch& search = surfaces_.search(bone_mesh(document_.scene(), target.key.bone));
    return stroke_vertices(search, before, at, target.brush);
}

void AreaStroke::apply(Target& target, std::vector<int> touched) {
    target.changed.clear();
    std::erase_if(touched, [&](int v) { return locked(v, target.key.bone); });
    if (touched.empty())
        return;
    const AttachmentArea* area = find_area(document_.scene(), target.key);
    if (options_.mode == StrokeMode::smooth) {
        if (area == nullptr)
            return;
        const SurfaceGraph& graph = surfaces_.graph(bone_mesh(document_.scene(), target.key.bone));
        const SurfaceRegion within(graph.vertex_count(), touched);
        const SurfaceRegion smooth = smooth_border(graph, area->vertices, smoothing_passes, &within);
        std::erase_if(touched, [&](int v) { return smooth.contains(v) == area->vertices.contains(v); });
    } else {
        const bool wanted = options_.mode == StrokeMode::paint;
        std::erase_if(touched,
                      [&](int v) { return (area != nullptr && area->vertices.contains(v)) == wanted; });
    }
    if (touched.empty())
        return;
    Scene& scene = document_.edit();
    const std::size_t index = area_index(scene, target.key);
    std::vector<AttachmentArea>& areas = muscle_of(scene, target.key).areas;
    for (const int v : touched) {
        SurfaceRegion& own = areas[index].vertices;
        if (own.contains(v)) {
            own.erase(v);
            continue;
        }
        own.insert(v);
        for (std::size_t i = 0; i < areas.size(); ++i)
            if (i != index && areas[i].bone == target.key.bone && v < areas[i].vertices.vertex_count())
                areas[i].vertices.erase(v);
    }
    target.changed = std::move(touched);
}

const std::vector<int>& AreaStroke::joined_changes() {
    std::vector<int>& changed = targets_.front().changed;
    if (targets_.size() > 1 &&
        targets_.back().key == targets_.front().key) { // both halves of one area on one bone
        changed.insert(changed.end(), targets_.back().changed.begin(), targets_.back().changed.end());
        std::sort(changed.begin(), changed.end());
    }
    return changed;
}

const std::vector<int>& AreaStroke::step(const SurfacePoint& at) {
    FASCICLE_ASSERT(open_);
    apply(targets_.front(), under_brush(targets_.front(), at));
    if (targets_.size() > 1) {
        const StrokeMirror& mirror = *options_.mirror;
        SurfacePoint image;
        if (at.triangle >= 0)
            image = mirror_point(at.point, surfaces_.graph(bone_mesh(document_.scene(), mirror.area.bone)),
                                 mirror.plane, mirror.reach);
        apply(targets_.back(), under_brush(targets_.back(), image));
    }
    return joined_changes();
}

const std::vector<int>& AreaStroke::touch(const std::vector<int>& vertices,
                                          const std::vector<int>& mirrored) {
    FASCICLE_ASSERT(open_);
    apply(targets_.front(), vertices);
    if (targets_.size() > 1)
        apply(targets_.back(), mirrored);
    return joined_changes();
}

bool AreaStroke::finish() {
    FASCICLE_ASSERT(open_);
    open_ = false;
    if (!document_.has_uncommitted_edits())
        return false;
    Scene& scene = document_.edit();
    for (const Target& target : targets_)
        drop_empty(muscle_of(scene, target.key));
    if (same_areas(scene, *document_.head())) {
        document_.discard_edits();
        return false;
    }
    const std::string what = options_.what.empty() ? verb(options_.mode) : options_.what;
    return document_.commit(step_name(scene, what, targets_.front().key));
}

void AreaStroke::cancel() {
    if (open_)
        document_.discard_edits();
    open_ = false;
}

} // namespace fascicle::actions
