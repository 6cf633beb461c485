#include "view/draw_cache.hpp"

#include "fascicle/anatomy/fibre_shape.hpp"
#include "fascicle/base/assert.hpp"
#include "fascicle/geometry/vertex_normals.hpp"
#include "fascicle/metrics/run_difference.hpp"
#include "view/colouring.hpp"
#include "view/vertex_extension.hpp"

namespace fascicle::view {

namespace {

render::Vec3f narrow(const Vec3& p) {
    return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

FloatPoints narrow(const Points& points) {
    auto result = std::make_shared<std::vector<render::Vec3f>>();
    result->reserve(points.size());
    for (const Vec3& p : points)
        result->push_back(narrow(p));
    return result;
}

/// Whether corners stand more than 40 degrees off their faces on average: the cube of 12 triangles (55), not the
/// icosahedron (37). Smooth normals would make such a surface look round where it is flat.
bool is_block(const TriMesh& mesh, const Points& normals) {
    double cosines = 0;
    std::size_t corners = 0;
    for (const Tri& t : mesh.triangles) {
        const auto at = [&](int k) -> const Vec3& {
            return mesh.positions[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])];
        };
        const Vec3 face = (at(1) - at(0)).cross(at(2) - at(0));
        if (!(face.norm() > 0))
            continue;
        for (const int v : t)
            cosines += face.normalized().dot(normals[static_cast<std::size_t>(v)]);
        corners += 3;
    }
    return corners > 0 && cosines / static_cast<double>(corners) < 0.766;
}

bool same(const std::vector<Attachment>& a, const std::vector<Attachment>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Attachment& x, const Attachment& y) {
        return x.kind == y.kind && x.bone == y.bone && x.vertices == y.vertices;
    });
}

} // namespace

PointsPtr mesh_points(const MeshPtr& mesh) {
    return {mesh, &mesh->positions};
}

DrawCache::Object& DrawCache::object(std::vector<Object>& list, std::size_t index, const MeshPtr& mesh) {
    FASCICLE_ASSERT(mesh != nullptr);
    if (index >= list.size())
        list.resize(index + 1);
    if (list[index].mesh != mesh) {
        list[index] = Object{};
        list[index].mesh = mesh;
    }
    return list[index];
}

const MeshTopology& DrawCache::topology(Object& object) {
    if (!object.topology) {
        object.topology = std::make_shared<MeshTopology>(object.mesh->vertex_count(), object.mesh->triangles);
        ++computed_;
    }
    return *object.topology;
}

SurfaceArrays DrawCache::make_surface(const Points& points, const TriMesh& mesh) {
    FASCICLE_ASSERT(points.size() == mesh.positions.size());
    ++computed_;
    return {narrow(points), narrow(vertex_normals(points, mesh.triangles))};
}

IndexTriangles DrawCache::triangles(std::size_t muscle_or_bone, bool bone, const MeshPtr& mesh) {
    Object& entry = object(bone ? bones_ : muscles_, muscle_or_bone, mesh);
    if (!entry.triangles) {
        auto result = std::make_shared<std::vector<std::array<std::uint32_t, 3>>>();
        result->reserve(mesh->triangles.size());
        for (const Tri& t : mesh->triangles)
            result->push_back({static_cast<std::uint32_t>(t[0]), static_cast<std::uint32_t>(t[1]),
                               static_cast<std::uint32_t>(t[2])});
        entry.triangles = result;
        ++computed_;
    }
    return entry.triangles;
}

SurfaceArrays DrawCache::bone_surface(std::size_t bone, const MeshPtr& mesh) {
    Object& entry = object(bones_, bone, mesh);
    if (!entry.surface.positions) {
        const Points normals = vertex_normals(mesh->positions, mesh->triangles);
        entry.surface = {narrow(mesh->positions), is_block(*mesh, normals) ? nullptr : narrow(normals)};
        ++computed_;
    }
    return entry.surface;
}

SurfaceArrays DrawCache::muscle_surface(std::size_t muscle, const MeshPtr& mesh, const PointsPtr& points) {
    Object& entry = object(muscles_, muscle, mesh);
    if (entry.points != points) {
        entry.surface = make_surface(*points, *mesh);
        entry.points = points;
    }
    return entry.surface;
}

SurfaceArrays DrawCache::ghost_surface(std::size_t muscle, const MeshPtr& mesh, const PointsPtr& rest) {
    Object& entry = object(muscles_, muscle, mesh);
    if (entry.ghost_points != rest) {
        entry.ghost = make_surface(*rest, *mesh);
        entry.ghost_points = rest;
    }
    return entry.ghost;
}

SurfaceArrays DrawCache::compared_surface(std::size_t muscle, const MeshPtr& mesh,
                                          const PointsPtr& compared) {
    Object& entry = object(muscles_, muscle, mesh);
    if (entry.compared_points != compared) {
        entry.compared = make_surface(*compared, *mesh);
        entry.compared_points = compared;
    }
    return entry.compared;
}

FloatPoints DrawCache::compared_edges(std::size_t muscle, const MeshPtr& mesh, const PointsPtr& compared) {
    Object& entry = object(muscles_, muscle, mesh);
    if (entry.edges_points == compared)
        return entry.compared_edges;
    auto ends = std::make_shared<std::vector<render::Vec3f>>();
    const std::vector<Edge>& edges = topology(entry).edges();
    ends->reserve(2 * edges.size());
    for (const Edge& edge : edges)
        for (const int v : {edge.a, edge.b})
            ends->push_back(narrow((*compared)[static_cast<std::size_t>(v)]));
    entry.compared_edges = ends;
    entry.edges_points = compared;
    ++computed_;
    return ends;
}

FloatColours DrawCache::difference_colours(std::size_t muscle, const MeshPtr& mesh, const PointsPtr& points,
                                           const PointsPtr& compared, double millimetres_per_unit,
                                           const ColourScale& scale) {
    Object& entry = object(muscles_, muscle, mesh);
    if (entry.difference_colours && entry.difference_points == points &&
        entry.difference_compared == compared && entry.difference_scale == scale)
        return entry.difference_colours;
    auto colours = std::make_shared<std::vector<render::Rgba>>();
    colours->reserve(points->size());
    for (const double mm : vertex_distances_mm(*points, *compared, millimetres_per_unit))
        colours->push_back(scale.colour(mm));
    entry.difference_colours = colours;
    entry.difference_points = points;
    entry.difference_compared = compared;
    entry.difference_scale = scale;
    ++computed_;
    return colours;
}

BoundingBox DrawCache::rest_bounds(const Scene& scene) {
    BoundingBox all;
    const auto add = [&](Object& entry) {
        if (!entry.bounds) {
            entry.bounds = bounding_box(entry.mesh->positions);
            ++computed_;
        }
        all.add(*entry.bounds);
    };
    for (std::size_t i = 0; i < scene.bones.size(); ++i)
        if (scene.bones[i].mesh)
            add(object(bones_, i, scene.bones[i].mesh));
    for (std::size_t i = 0; i < scene.muscles.size(); ++i)
        if (scene.muscles[i].mesh)
            add(object(muscles_, i, scene.muscles[i].mesh));
    return all;
}

void DrawCache::set_attachments(Object& object, const std::vector<Attachment>& attachments) {
    if (object.has_attachments && same(object.attachments, attachments))
        return;
    object.attachments = attachments;
    object.has_attachments = true;
    object.kinds = vertex_kinds(object.mesh->vertex_count(), attachments);
    object.segments = border_segments(object.mesh->triangles, object.kinds);
    object.kind_colours = nullptr;
    object.border_colours = nullptr;
    object.border_for = nullptr;
    object.contact_colours = nullptr;
    ++computed_;
}

FloatColours DrawCache::attachment_colours(std::size_t muscle, const MeshPtr& mesh,
                                           const std::vector<Attachment>& attachments,
                                           const render::Rgba& base) {
    Object& entry = object(muscles_, muscle, mesh);
    set_attachments(entry, attachments);
    if (entry.kind_colours && entry.kind_base == base)
        return entry.kind_colours;
    auto colours = std::make_shared<std::vector<render::Rgba>>(mesh->positions.size(), base);
    for (std::size_t i = 0; i < colours->size(); ++i)
        if (entry.kinds[i])
            (*colours)[i] = attachment_colour(*entry.kinds[i]);
    entry.kind_colours = colours;
    entry.kind_base = base;
    ++computed_;
    return colours;
}

FloatColours DrawCache::extension_colours(std::size_t muscle, const MeshPtr& mesh, const PointsPtr& rest,
                                          const PointsPtr& points, const ColourScale& scale) {
    Object& entry = object(muscles_, muscle, mesh);
    if (entry.extension_colours && entry.extension_rest == rest && entry.extension_points == points &&
        entry.extension_scale == scale)
        return entry.extension_colours;
    auto colours = std::make_shared<std::vector<render::Rgba>>();
    colours->reserve(points->size());
    for (const double extension : vertex_extension(topology(entry), *rest, *points))
        colours->push_back(scale.colour(extension));
    entry.extension_colours = colours;
    entry.extension_rest = rest;
    entry.extension_points = points;
    entry.extension_scale = scale;
    ++computed_;
    return colours;
}

FloatColours DrawCache::depth_colours(const Scene& scene, std::size_t muscle, const PointsPtr& points,
                                      const std::vector<Pose>& poses, const ColourScale& scale) {
    Object& entry = object(muscles_, muscle, scene.muscles[muscle].mesh);
    const BoneDistances distances = distances_.distances(scene, muscle, points, poses);
    if (entry.depth_colours && entry.depth_for == distances && entry.depth_scale == scale)
        return entry.depth_colours;
    auto colours = std::make_shared<std::vector<render::Rgba>>();
    colours->reserve(distances->size());
    for (const BoneDistance& distance : *distances)
        colours->push_back(scale.colour(distance.mm));
    entry.depth_colours = colours;
    entry.depth_for = distances;
    entry.depth_scale = scale;
    ++computed_;
    return colours;
}

FloatColours DrawCache::contact_colours(const Scene& scene, std::size_t muscle, const PointsPtr& points,
                                        const std::vector<Pose>& poses,
                                        const std::vector<Attachment>& attachments) {
    Object& entry = object(muscles_, muscle, scene.muscles[muscle].mesh);
    set_attachments(entry, attachments);
    const BoneDistances distances = distances_.distances(scene, muscle, points, poses);
    if (entry.contact_colours && entry.contact_for == distances)
        return entry.contact_colours;
    auto colours = std::make_shared<std::vector<render::Rgba>>();
    colours->reserve(distances->size());
    for (std::size_t v = 0; v < distances->size(); ++v) {
        const ContactState state = contact_state((*distances)[v].mm, entry.kinds[v].has_value());
        colours->push_back(contact_rows()[static_cast<std::size_t>(state)].colour);
    }
    entry.contact_colours = colours;
    entry.contact_for = distances;
    ++computed_;
    return colours;
}

BorderLines DrawCache::fibre_lines(std::size_t muscle, const MeshPtr& mesh, const FibreModelPtr& fibres,
                                   const PointsPtr& rest, const PointsPtr& points, const ColourScale* scale) {
    Object& entry = object(muscles_, muscle, mesh);
    const std::optional<ColourScale> wanted = scale ? std::optional(*scale) : std::nullopt;
    if (entry.fibres == fibres && entry.fibres_rest == rest && entry.fibres_points == points &&
        entry.fibres_scale == wanted)
        return entry.fibre_lines;
    FibreSet now = fibres->rest, before = fibres->rest;
    fibres->carrier.carry(*points, now.points);
    fibres->carrier.carry(*rest, before.points);
    const auto n = now.points_per_fibre();
    auto ends = std::make_shared<std::vector<render::Vec3f>>();
    auto colours = scale ? std::make_shared<std::vector<render::Rgba>>() : nullptr;
    const std::vector<double> stretch = scale ? segment_stretch(now, before) : std::vector<double>{};
    for (std::size_t f = 0; f < static_cast<std::size_t>(now.count); ++f)
        for (std::size_t j = 0; j + 1 < n; ++j) {
            ends->push_back(narrow(now.points[f * n + j]));
            ends->push_back(narrow(now.points[f * n + j + 1]));
            if (colours)
                colours->insert(colours->end(), 2, scale->colour(stretch[f * (n - 1) + j]));
        }
    entry.fibres = fibres;
    entry.fibres_rest = rest;
    entry.fibres_points = points;
    entry.fibres_scale = wanted;
    entry.fibre_lines = {ends, colours};
    ++computed_;
    return entry.fibre_lines;
}

FloatPoints DrawCache::line_paths(const ScenePtr& scene, const FramePtr& frame) {
    if (line_paths_ && lines_scene_ == scene && lines_frame_ == frame)
        return line_paths_;
    if (lines_ == nullptr || lines_scene_ != scene)
        lines_ = std::make_unique<LineTracker>(*scene);
    lines_scene_ = scene;
    lines_frame_ = frame;
    lines_->set_frame(frame.get());
    auto ends = std::make_shared<std::vector<render::Vec3f>>();
    for (std::size_t m = 0; m < lines_->muscle_count(); ++m) {
        if (!lines_->has_bones(m))
            continue;
        const Points path = lines_->measure(m, true).polyline;
        for (std::size_t i = 0; i + 1 < path.size(); ++i) {
            ends->push_back(narrow(path[i]));
            ends->push_back(narrow(path[i + 1]));
        }
    }
    line_paths_ = ends;
    ++computed_;
    return line_paths_;
}

const ShownAreas& DrawCache::scene_areas(const ScenePtr& scene) {
    if (scene_areas_ == nullptr || areas_scene_ != scene) {
        std::vector<std::vector<AttachmentArea>> by_muscle;
        for (const Muscle& muscle : scene->muscles)
            by_muscle.push_back(muscle.areas);
        scene_areas_ = shown_areas(by_muscle);
        areas_scene_ = scene;
    }
    return scene_areas_;
}

const AreaMarks& DrawCache::bone_marks(std::size_t bone, const MeshPtr& mesh, const ShownAreas& areas,
                                       const std::shared_ptr<const std::vector<BoneHighlight>>& highlights,
                                       const render::Rgba& base) {
    if (bone >= bone_marks_.size())
        bone_marks_.resize(bone + 1);
    BoneMarks& own = bone_marks_[bone];
    const bool fresh = own.marks == nullptr || own.marks->mesh() != mesh;
    if (fresh)
        own.marks = std::make_unique<AreaMarks>(mesh);
    if (fresh || own.areas != areas || own.highlights != highlights || own.base != base) {
        static const std::vector<BoneHighlight> none;
        own.marks->update(static_cast<int>(bone), *areas, highlights ? *highlights : none, base);
        own.areas = areas;
        own.highlights = highlights;
        own.base = base;
        ++computed_;
    }
    return *own.marks;
}

BorderLines DrawCache::attachment_border(std::size_t muscle, const MeshPtr& mesh,
                                         const std::vector<Attachment>& attachments,
                                         const PointsPtr& points) {
    Object& entry = object(muscles_, muscle, mesh);
    set_attachments(entry, attachments);
    if (!entry.border_colours) {
        auto colours = std::make_shared<std::vector<render::Rgba>>();
        for (const BorderSegment& segment : entry.segments) {
            render::Rgba colour = attachment_colour(segment.kind);
            for (std::size_t c = 0; c < 3; ++c)
                colour[c] *= 0.55f; // darker than the area it encloses
            colours->insert(colours->end(), 2, colour);
        }
        entry.border_colours = colours;
        ++computed_;
    }
    if (entry.border_for != points) {
        auto ends = std::make_shared<std::vector<render::Vec3f>>();
        ends->reserve(2 * entry.segments.size());
        const auto middle = [&](int a, int b) {
            return narrow(Vec3(
                0.5 * ((*points)[static_cast<std::size_t>(a)] + (*points)[static_cast<std::size_t>(b)])));
        };
        for (const BorderSegment& segment : entry.segments) {
            ends->push_back(middle(segment.a0, segment.a1));
            ends->push_back(middle(segment.b0, segment.b1));
        }
        entry.border_points = ends;
        entry.border_for = points;
        ++computed_;
    }
    return {entry.border_points, entry.border_colours};
}

} // namespace fascicle::view
