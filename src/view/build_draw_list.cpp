#include "view/build_draw_list.hpp"

#include "fascicle/base/assert.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::view {

namespace {

/// Of what is not being painted: it lets the bone through and still tells where things are.
constexpr float faded_opacity = 0.16f;

/// How far other surfaces take light away, as a share of the scene's diagonal.
constexpr double occlusion_reach = 0.06;

constexpr std::uint64_t ghost_ids = std::uint64_t{3} << 32;
constexpr std::uint64_t compared_ids = std::uint64_t{0x43} << 32;

render::Mat4f model_matrix(const Pose& pose) {
    render::Mat4f m{};
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            m[static_cast<std::size_t>(4 * column + row)] = static_cast<float>(pose.rotation(row, column));
    for (int row = 0; row < 3; ++row)
        m[static_cast<std::size_t>(12 + row)] = static_cast<float>(pose.translation[row]);
    m[15] = 1.0f;
    return m;
}

Pose bone_pose(const ViewSubject& subject, std::size_t bone) {
    return subject.frame ? subject.frame->bone_poses[bone] : Pose{};
}

PointsPtr muscle_points(const FramePtr& frame, const Muscle& muscle, std::size_t index) {
    return frame ? frame->muscle_positions[index] : mesh_points(muscle.mesh);
}

const std::vector<Attachment>& attachments_of(const ViewSubject& subject, std::size_t muscle) {
    return muscle < subject.attachments.size() ? subject.attachments[muscle]
                                               : subject.scene->muscles[muscle].attachments;
}

/// Of another run; null: none.
PointsPtr compared_points(const ViewSubject& subject, const ViewOptions& options, std::size_t muscle) {
    return options.compared != Compared::none && muscle < subject.compared.size() ? subject.compared[muscle]
                                                                                  : nullptr;
}

FibreModelPtr fibres_of(const ViewSubject& subject, std::size_t muscle) {
    return muscle < subject.fibres.size() ? subject.fibres[muscle] : nullptr;
}

/// Colours of the chosen quantity; null: the item's one colour.
FloatColours muscle_colours(const ViewSubject& subject, const ViewOptions& options, DrawCache& cache,
                            std::size_t i, const render::Rgba& base) {
    const Scene& scene = *subject.scene;
    const Muscle& muscle = scene.muscles[i];
    const PointsPtr points = muscle_points(subject.frame, muscle, i);
    const std::vector<Attachment>& attachments = attachments_of(subject, i);
    const auto poses = [&] {
        return subject.frame ? subject.frame->bone_poses : std::vector<Pose>(scene.bones.size());
    };
    if (const PointsPtr other = compared_points(subject, options, i);
        other != nullptr && options.compared == Compared::difference)
        return cache.difference_colours(i, muscle.mesh, points, other, millimetres_per_unit(scene.unit),
                                        options.difference_scale);
    const ColourScale& scale = options.scales[options.colouring];
    const auto field = [&](RestField which) {
        return cache.field_colours(which, {subject.scene, i, attachments, fibres_of(subject, i)}, scale);
    };
    switch (options.colouring) {
    case Colouring::anatomy:
    case Colouring::fibres:
        break;
    case Colouring::strain:
        return cache.extension_colours(i, muscle.mesh, muscle_points(subject.rest, muscle, i), points, scale);
    case Colouring::dihedral:
        return cache.dihedral_colours(i, muscle.mesh, muscle_points(subject.rest, muscle, i), points, scale);
    case Colouring::depth:
        return cache.depth_colours(scene, i, points, poses(), scale);
    case Colouring::distance:
        return cache.distance_colours(scene, i, points, poses(), scale);
    case Colouring::contact:
        return cache.contact_colours(scene, i, points, poses(), attachments);
    case Colouring::stiffness:
        return field(RestField::stiffness);
    case Colouring::harmonic:
        return field(RestField::harmonic);
    }
    if (options.attachments && !attachments.empty())
        return cache.attachment_colours(i, muscle.mesh, attachments, base);
    return nullptr;
}

render::Rgba brighter(render::Rgba colour) {
    for (std::size_t c = 0; c < 3; ++c)
        colour[c] += 0.35f * (1.0f - colour[c]);
    return colour;
}

void require_fitting(const Scene& scene, const FramePtr& frame) {
    if (!frame)
        return;
    FASCICLE_ASSERT(frame->bone_poses.size() == scene.bones.size());
    FASCICLE_ASSERT(frame->muscle_positions.size() == scene.muscles.size());
}

const ShownAreas& areas_of(const ViewSubject& subject, DrawCache& cache) {
    return subject.areas ? subject.areas : cache.scene_areas(subject.scene);
}

bool has_marks(const ViewSubject& subject, std::size_t bone, DrawCache& cache) {
    const auto here = [&](int b) { return b == static_cast<int>(bone); };
    for (const ShownArea& shown : *areas_of(subject, cache))
        if (here(shown.area.bone))
            return true;
    if (subject.highlights != nullptr)
        for (const BoneHighlight& highlight : *subject.highlights)
            if (here(highlight.bone))
                return true;
    return false;
}

/// Lines have no matrix of their own.
FloatPoints placed(const std::vector<render::Vec3f>& points, const render::Mat4f& m) {
    auto result = std::make_shared<std::vector<render::Vec3f>>();
    result->reserve(points.size());
    for (const render::Vec3f& p : points)
        result->push_back({m[0] * p[0] + m[4] * p[1] + m[8] * p[2] + m[12],
                           m[1] * p[0] + m[5] * p[1] + m[9] * p[2] + m[13],
                           m[2] * p[0] + m[6] * p[1] + m[10] * p[2] + m[14]});
    return result;
}

/// Dots, faintly over what hides them too: a segment without length is drawn as a disc.
void add_marked_vertices(render::DrawList& list, const ViewSubject& subject) {
    if (subject.marked == nullptr || subject.marked->muscle < 0 ||
        static_cast<std::size_t>(subject.marked->muscle) >= subject.scene->muscles.size())
        return;
    const auto m = static_cast<std::size_t>(subject.marked->muscle);
    const PointsPtr points = muscle_points(subject.frame, subject.scene->muscles[m], m);
    auto ends = std::make_shared<std::vector<render::Vec3f>>();
    for (const int v : subject.marked->vertices)
        if (v >= 0 && static_cast<std::size_t>(v) < points->size()) {
            const Vec3& p = (*points)[static_cast<std::size_t>(v)];
            ends->insert(ends->end(), 2, {float(p.x()), float(p.y()), float(p.z())});
        }
    if (ends->empty())
        return;
    render::LineItem line;
    line.points = ends;
    line.colour = palette::fixed_vertex;
    line.width_px = 4.0f;
    list.lines.push_back(line);
    line.colour[3] = 0.35f;
    line.on_top = true;
    list.lines.push_back(std::move(line));
}

void add_bones(render::DrawList& list, const ViewSubject& subject, const ViewOptions& options,
               DrawCache& cache) {
    for (std::size_t i = 0; i < subject.scene->bones.size(); ++i) {
        const MeshPtr& mesh = subject.scene->bones[i].mesh;
        if (!options.bone_visible(i) || !mesh)
            continue;
        const SurfaceArrays arrays = cache.bone_surface(i, mesh);
        render::SurfaceItem item;
        item.id = bone_item_id(i);
        item.positions = arrays.positions;
        item.normals = arrays.normals;
        item.triangles = cache.triangles(i, true, mesh);
        item.colour = static_cast<int>(i) == options.selected_bone ? brighter(palette::bone) : palette::bone;
        const bool faded = options.focus_bone >= 0 && options.focus_bone != static_cast<int>(i);
        item.model = model_matrix(bone_pose(subject, i));
        if (options.attachments && has_marks(subject, i, cache)) {
            const AreaMarks& marks =
                cache.bone_marks(i, mesh, areas_of(subject, cache), subject.highlights, item.colour);
            item.live_colours = marks.colours();
            if (!marks.border_points()->empty()) {
                render::LineItem line;
                line.points = placed(*marks.border_points(), item.model);
                line.point_colours = marks.border_colours();
                line.width_px = options.focus_bone == static_cast<int>(i) ? 2.5f : 1.8f;
                list.lines.push_back(std::move(line));
            }
        }
        item.colour[3] = faded ? std::min(options.bone_opacity, faded_opacity) : options.bone_opacity;
        item.gloss = 0.12f;
        item.wireframe = options.wireframe;
        item.cap = palette::cut_bone;
        list.surfaces.push_back(std::move(item));
    }
}

/// Another run's muscle over this one.
void add_compared(render::DrawList& list, const ViewSubject& subject, const ViewOptions& options,
                  DrawCache& cache, std::size_t i) {
    const MeshPtr& mesh = subject.scene->muscles[i].mesh;
    const PointsPtr other = compared_points(subject, options, i);
    if (other == nullptr || options.compared == Compared::difference)
        return;
    if (options.compared == Compared::wire) {
        render::LineItem line;
        line.points = cache.compared_edges(i, mesh, other);
        line.colour = palette::compared;
        line.colour[3] = 0.35f; // a fine mesh would cover all
        line.width_px = 1.0f;
        list.lines.push_back(std::move(line));
        return;
    }
    const SurfaceArrays arrays = cache.compared_surface(i, mesh, other);
    render::SurfaceItem item;
    item.id = compared_ids | i;
    item.positions = arrays.positions;
    item.normals = arrays.normals;
    item.triangles = cache.triangles(i, false, mesh);
    item.colour = palette::compared;
    item.gloss = 0.1f;
    list.surfaces.push_back(std::move(item));
}

void add_muscle(render::DrawList& list, const ViewSubject& subject, const ViewOptions& options,
                DrawCache& cache, std::size_t i) {
    const Muscle& muscle = subject.scene->muscles[i];
    const PointsPtr points = muscle_points(subject.frame, muscle, i);
    const PointsPtr rest = muscle_points(subject.rest, muscle, i);
    const std::vector<Attachment>& attachments = attachments_of(subject, i);
    const SurfaceArrays arrays = cache.muscle_surface(i, muscle.mesh, points);
    const IndexTriangles triangles = cache.triangles(i, false, muscle.mesh);

    render::SurfaceItem item;
    item.id = muscle_item_id(i);
    item.positions = arrays.positions;
    item.normals = arrays.normals;
    item.triangles = triangles;
    item.colour =
        static_cast<int>(i) == options.selected_muscle ? brighter(palette::muscle) : palette::muscle;
    item.vertex_colours = muscle_colours(subject, options, cache, i, item.colour);
    if (item.vertex_colours == nullptr && colouring_row(options.colouring).has_scale() &&
        options.colouring != Colouring::fibres)
        item.colour = palette::no_value;
    item.cap = palette::cut_muscle;
    const FibreModelPtr fibres = options.fibres ? fibres_of(subject, i) : nullptr;
    const bool through = options.colouring == Colouring::fibres && fibres != nullptr &&
                         options.compared != Compared::difference;
    const bool faded = options.focus_bone >= 0;
    item.colour[3] = faded     ? std::min(options.muscle_opacity, faded_opacity)
                     : through ? std::min(options.muscle_opacity, 0.25f)
                               : options.muscle_opacity;
    if (through && item.vertex_colours == nullptr)
        item.gloss = 0.0f;
    if (fibres != nullptr && item.colour[3] < 1.0f && !faded) {
        const BorderLines lines = cache.fibre_lines(
            i, muscle.mesh, fibres, rest, points,
            options.colouring == Colouring::fibres ? &options.scales[Colouring::fibres] : nullptr);
        render::LineItem line;
        line.points = lines.points;
        line.point_colours = lines.colours;
        line.colour = palette::fibre;
        line.width_px = 1.6f;
        list.lines.push_back(std::move(line));
    }
    // A highlight would hide the colour that is read as a number.
    const bool plain = options.colouring == Colouring::anatomy && options.compared != Compared::difference;
    item.gloss = plain ? 0.42f : 0.1f;
    item.wireframe = options.wireframe;
    list.surfaces.push_back(std::move(item));

    if (options.attachments && !attachments.empty() && !faded) {
        const BorderLines border = cache.attachment_border(i, muscle.mesh, attachments, points);
        if (!border.points->empty()) {
            render::LineItem line;
            line.points = border.points;
            line.point_colours = border.colours;
            line.width_px = 1.5f;
            list.lines.push_back(std::move(line));
        }
    }
    add_compared(list, subject, options, cache, i);
    if (options.rest_ghost && subject.frame && subject.rest && points != rest) {
        const SurfaceArrays ghost = cache.ghost_surface(i, muscle.mesh, rest);
        render::SurfaceItem faint;
        faint.id = ghost_ids | i;
        faint.positions = ghost.positions;
        faint.normals = ghost.normals;
        faint.triangles = triangles;
        faint.colour = palette::ghost;
        faint.gloss = 0.0f;
        list.surfaces.push_back(std::move(faint));
    }
}

// The axis reaches 10 % of the scene's diagonal beyond the scene at rest, once hidden by surfaces and once faintly over
// them, so that its place inside the joint can be read.
void add_joint_axis(render::DrawList& list, const ViewSubject& subject, const ViewOptions& options,
                    DrawCache& cache) {
    const std::optional<Hinge>& hinge = subject.scene->timeline.hinge;
    if (!options.joint_axis || !hinge || !(hinge->axis.norm() > 0))
        return;
    const BoundingBox box = cache.rest_bounds(*subject.scene);
    if (box.empty())
        return;
    const Vec3 axis = hinge->axis.normalized();
    double low = 0, high = 0; // the centre is always on it
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 p(corner & 1 ? box.max.x() : box.min.x(), corner & 2 ? box.max.y() : box.min.y(),
                     corner & 4 ? box.max.z() : box.min.z());
        low = std::min(low, (p - hinge->centre).dot(axis));
        high = std::max(high, (p - hinge->centre).dot(axis));
    }
    const double beyond = 0.1 * box.diagonal();
    const Vec3 start = hinge->centre + (low - beyond) * axis, end = hinge->centre + (high + beyond) * axis;
    render::LineItem line;
    line.points = std::make_shared<const std::vector<render::Vec3f>>(std::vector<render::Vec3f>{
        {static_cast<float>(start.x()), static_cast<float>(start.y()), static_cast<float>(start.z())},
        {static_cast<float>(end.x()), static_cast<float>(end.y()), static_cast<float>(end.z())}});
    line.colour = palette::joint_axis;
    line.width_px = 2.0f;
    list.lines.push_back(line);
    line.colour[3] = 0.35f;
    line.on_top = true;
    list.lines.push_back(std::move(line));
}

// Line muscles run inside of surfaces that they know nothing of: once hidden by them, once faintly over them.
void add_line_muscles(render::DrawList& list, const ViewSubject& subject, const ViewOptions& options,
                      DrawCache& cache) {
    if (!options.line_muscles || subject.scene->line_muscles == nullptr)
        return;
    render::LineItem line;
    line.points = cache.line_paths(subject.scene, subject.frame);
    if (line.points->empty())
        return;
    line.colour = palette::line_muscle;
    line.width_px = 2.0f;
    list.lines.push_back(line);
    line.colour[3] = 0.4f;
    line.on_top = true;
    list.lines.push_back(std::move(line));
}

} // namespace

std::uint64_t bone_item_id(std::size_t bone) {
    return (std::uint64_t{1} << 32) | bone;
}

std::uint64_t muscle_item_id(std::size_t muscle) {
    return (std::uint64_t{2} << 32) | muscle;
}

ViewSubject subject_of(ScenePtr scene) {
    return {std::move(scene), nullptr, nullptr, {}};
}

ViewSubject subject_of(const Recording& recording, int k) {
    FramePtr frame = recording.frame(k);
    if (!frame)
        frame = recording.last_frame();
    return {recording.scene_ptr(), std::move(frame), recording.frame(0), recording.attachments(),
            recording.fibres()};
}

render::DrawList build_draw_list(const ViewSubject& subject, const ViewOptions& options,
                                 const render::CameraPose& camera, DrawCache& cache) {
    FASCICLE_ASSERT(subject.scene != nullptr);
    require_fitting(*subject.scene, subject.frame);
    require_fitting(*subject.scene, subject.rest);
    render::DrawList list;
    list.camera = camera;
    if (options.section) {
        const Vec3 n = -options.section->normal;
        list.section = {static_cast<float>(n.x()), static_cast<float>(n.y()), static_cast<float>(n.z()),
                        static_cast<float>(options.section->position)};
    }
    if (const BoundingBox box = cache.rest_bounds(*subject.scene); options.occlusion && !box.empty())
        list.occlusion_radius = static_cast<float>(occlusion_reach * box.diagonal());
    add_bones(list, subject, options, cache);
    for (std::size_t i = 0; i < subject.scene->muscles.size(); ++i)
        if (options.muscle_visible(i) && subject.scene->muscles[i].mesh)
            add_muscle(list, subject, options, cache, i);
    add_marked_vertices(list, subject);
    add_line_muscles(list, subject, options, cache);
    add_joint_axis(list, subject, options, cache);
    return list;
}

Points visible_points(const ViewSubject& subject, const ViewOptions& options) {
    const Scene& scene = *subject.scene;
    Points points;
    const auto add_all = [&](const auto& bone_shown, const auto& muscle_shown) {
        for (std::size_t i = 0; i < scene.bones.size(); ++i)
            if (scene.bones[i].mesh && bone_shown(i)) {
                const Pose pose = bone_pose(subject, i);
                for (const Vec3& p : scene.bones[i].mesh->positions)
                    points.push_back(pose.apply(p));
            }
        for (std::size_t i = 0; i < scene.muscles.size(); ++i)
            if (scene.muscles[i].mesh && muscle_shown(i)) {
                const PointsPtr muscle = muscle_points(subject.frame, scene.muscles[i], i);
                points.insert(points.end(), muscle->begin(), muscle->end());
            }
    };
    add_all([&](std::size_t i) { return options.bone_visible(i); },
            [&](std::size_t i) { return options.muscle_visible(i); });
    if (points.empty())
        add_all([](std::size_t) { return true; }, [](std::size_t) { return true; });
    return points;
}

BoundingBox visible_bounds(const ViewSubject& subject, const ViewOptions& options) {
    return bounding_box(visible_points(subject, options));
}

BoundingBox motion_bounds(const Scene& scene) {
    BoundingBox box;
    for (const Muscle& muscle : scene.muscles)
        if (muscle.mesh)
            box.add(bounding_box(muscle.mesh->positions));
    constexpr int samples = 25;
    for (std::size_t i = 0; i < scene.bones.size(); ++i) {
        if (!scene.bones[i].mesh)
            continue;
        const BoundingBox rest = bounding_box(scene.bones[i].mesh->positions);
        if (rest.empty())
            continue;
        box.add(rest);
        for (int k = 0; k < samples; ++k) {
            const double frame = static_cast<double>(scene.timeline.last_frame) * k / (samples - 1);
            const Pose pose = scene.timeline.bone_pose(static_cast<int>(i), frame);
            for (int corner = 0; corner < 8; ++corner)
                box.add(pose.apply(Vec3(corner & 1 ? rest.max.x() : rest.min.x(),
                                        corner & 2 ? rest.max.y() : rest.min.y(),
                                        corner & 4 ? rest.max.z() : rest.min.z())));
        }
    }
    return box;
}

Camera picture_camera(const ViewSubject& subject, double aspect, const ViewOptions& options,
                      std::optional<StandardView> standard, WorldAxes axes) {
    Camera camera(axes);
    if (standard)
        camera.look_from(*standard);
    else
        camera.orbit_by(35.0 * 3.14159265358979323846 / 180.0, 12.0 * 3.14159265358979323846 / 180.0);
    const Points points = visible_points(subject, options);
    BoundingBox reach = motion_bounds(*subject.scene);
    reach.add(bounding_box(points));
    camera.set_scene_bounds(reach);
    camera.frame(points, aspect);
    return camera;
}

} // namespace fascicle::view
