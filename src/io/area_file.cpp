#include "fascicle/io/area_file.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/geometry/bounding_box.hpp"
#include "fascicle/geometry/region_border.hpp"
#include "fascicle/io/attachment_file.hpp"
#include "fascicle/io/csv.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/mesh_file.hpp"

#include <algorithm>
#include <sstream>

namespace fascicle {
namespace {

const char* const array_name = "attachment";

/// A border and what lies on its smaller side.
struct Loop {
    Points points;
    SurfaceRegion enclosed;
};

/// Whether a loop bounds a hole: the vertices just inside of it are not of the area. Those nearest to the loop tell; a vertex
/// enclosed that has a neighbour outside of the loop is one of them.
bool is_hole(const Loop& loop, const SurfaceGraph& graph, const SurfaceRegion& area) {
    int in = 0, out = 0;
    loop.enclosed.for_each([&](int v) {
        for (const int n : graph.topology().vertex_neighbours(v))
            if (!loop.enclosed.contains(n)) {
                ++(area.contains(v) ? in : out);
                break;
            }
    });
    return out > in;
}

const Bone& bone_at(const Scene& scene, int bone) {
    return scene.bones.at(static_cast<std::size_t>(bone));
}

} // namespace

std::string area_outlines_csv(const Scene& scene, const Muscle& muscle, BoneSurfaces& surfaces,
                              std::vector<std::string>& notes) {
    std::ostringstream out;
    CsvWriter csv(out);
    for (const char* column : {"attachment", "bone", "head", "loop", "hole", "x_mm", "y_mm", "z_mm"})
        csv.text(column);
    csv.end_row();
    const double unit_mm = millimetres_per_unit(scene.unit);
    for (const AttachmentArea& area : muscle.areas) {
        if (area.vertices.empty())
            continue;
        const Bone& bone = bone_at(scene, area.bone);
        const std::string who = muscle.name + ": " + area_text(area, bone.name);
        if (area.vertices.vertex_count() != bone.mesh->vertex_count())
            throw_error(who, "the area was made for another mesh of the bone");
        GeodesicSearch& search = surfaces.search(bone.mesh);
        const auto loops = region_border(search.graph(), area.vertices);
        if (loops.empty())
            throw_error(who, "the area has no border", "an area that does not cover the whole bone");
        std::vector<Loop> written;
        for (const BorderLoop& loop : loops) {
            Points points = border_positions(search.graph(), loop);
            SurfaceRegion enclosed = area_from_outline(search, points, outline_area_rules(unit_mm), who);
            written.push_back({std::move(points), std::move(enclosed)});
        }
        // Outer ones first, so that an island in a hole comes after the hole.
        std::stable_sort(written.begin(), written.end(),
                         [](const Loop& x, const Loop& y) { return x.enclosed.size() > y.enclosed.size(); });
        SurfaceRegion inside(area.vertices.vertex_count());
        for (std::size_t i = 0; i < written.size(); ++i) {
            const bool hole = is_hole(written[i], search.graph(), area.vertices);
            if (hole)
                inside -= written[i].enclosed;
            else
                inside |= written[i].enclosed;
            for (const Vec3& p : written[i].points) {
                csv.text(to_text(area.kind)).text(bone.name).text(area.head);
                csv.integer(static_cast<long long>(i) + 1).integer(hole ? 1 : 0);
                for (int k = 0; k < 3; ++k)
                    csv.number(p[k] * unit_mm);
                csv.end_row();
            }
        }
        if (const int lost = (inside - area.vertices).size() + (area.vertices - inside).size(); lost > 0)
            notes.push_back(who + ": the outlines differ from the area by " + std::to_string(lost) + " of " +
                            std::to_string(area.vertices.size()) + " vertices when read back");
    }
    return out.str();
}

void write_area_outlines(const std::filesystem::path& path, const Scene& scene, const Muscle& muscle,
                         BoneSurfaces& surfaces, std::vector<std::string>& notes) {
    write_file(path, area_outlines_csv(scene, muscle, surfaces, notes));
}

MeshData area_mesh(const Scene& scene, int bone, int only) {
    MeshData data;
    data.mesh = *bone_at(scene, bone).mesh;
    for (std::size_t m = 0; m < scene.muscles.size(); ++m) {
        if (only >= 0 && static_cast<int>(m) != only)
            continue;
        const Muscle& muscle = scene.muscles[m];
        bool any = only >= 0;
        for (const AttachmentArea& area : muscle.areas)
            any = any || area.bone == bone;
        if (any)
            data.point_arrays.push_back({only >= 0 ? array_name : array_name + (":" + muscle.name), 1,
                                         area_labels(muscle.areas, bone, data.mesh.vertex_count())});
    }
    return data;
}

std::vector<AttachmentArea> areas_from_mesh(const MeshData& mesh, const std::string& file, const Scene& scene,
                                            int bone, const std::string& muscle_name) {
    const TriMesh& surface = *bone_at(scene, bone).mesh;
    const std::string& bone_name = bone_at(scene, bone).name;
    if (mesh.mesh.vertex_count() != surface.vertex_count())
        throw_error(file,
                    "the mesh has " + std::to_string(mesh.mesh.vertex_count()) + " vertices, bone '" +
                        bone_name + "' " + std::to_string(surface.vertex_count()),
                    "the bone's own mesh");
    const double near = 1e-4 * bounding_box(surface.positions).diagonal();
    for (std::size_t v = 0; v < surface.positions.size(); ++v)
        if (!((surface.positions[v] - mesh.mesh.positions[v]).norm() <= near))
            throw_error(file, "vertex " + std::to_string(v) + " is not where bone '" + bone_name + "' has it",
                        "the bone's own mesh");
    const NamedArray* found = nullptr;
    for (const std::string& wanted : {std::string(array_name), array_name + (":" + muscle_name)})
        for (const NamedArray& array : mesh.point_arrays)
            if (array.name == wanted)
                found = &array;
    if (found == nullptr || found->components != 1)
        throw_error(file, "no point array 'attachment' with one number a vertex",
                    "0 none, 1 origin, 2 insertion, 3 and 4 for a second head");
    return areas_from_labels(found->values, bone, file + ", array '" + found->name + "'");
}

std::vector<AttachmentArea> read_area_mesh(const std::filesystem::path& path, const Scene& scene, int bone,
                                           const std::string& muscle_name) {
    MeshFile file = read_mesh_file(path);
    MeshData data;
    data.mesh = std::move(file.mesh);
    data.point_arrays = std::move(file.point_arrays);
    return areas_from_mesh(data, path.string(), scene, bone, muscle_name);
}

SurfaceRegion read_area_patch(const std::filesystem::path& path, const Bone& bone, BoneSurfaces& surfaces,
                              double tolerance) {
    const MeshFile file = read_mesh_file(path);
    if (!file.report.usable() || file.mesh.triangles.empty())
        throw_error(path.string(), "the file holds no usable surface", "a patch of triangles");
    SurfaceRegion region = area_from_patch(surfaces.graph(bone.mesh), file.mesh, tolerance);
    if (region.empty())
        throw_error(path.string(), "no vertex of bone '" + bone.name + "' lies near the patch",
                    "a patch on the bone, in the unit of the scene");
    return region;
}

} // namespace fascicle
