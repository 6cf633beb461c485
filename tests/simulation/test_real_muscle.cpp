// The whole path on real data: gluteus maximus through a flexion of the hip, as the command line runs it.

#include "fascicle/geometry/bvh.hpp"
#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/geometry/remesh.hpp"
#include "fascicle/geometry/volume.hpp"
#include "fascicle/geometry/winding_number.hpp"
#include "fascicle/io/load_scene.hpp"
#include "fascicle/metrics/fibre_measure.hpp"
#include "fascicle/metrics/metric_table.hpp"
#include "fascicle/simulation/simulation.hpp"
#include "support/data_dir.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace fascicle;

namespace {

/// Beside the metric: no bounds kept from frame to frame, the winding number to within 0.0003 at every vertex.
class InsideOracle {
public:
    explicit InsideOracle(const Scene& scene) {
        for (const Bone& bone : scene.bones)
            bones_.push_back({TriangleBvh(*bone.mesh), WindingNumber(*bone.mesh)});
    }

    /// Depth of every point in every bone, mm, 0 outside: [bone][point].
    std::vector<std::vector<double>> depths(const Frame& frame, const Points& points) const {
        std::vector<std::vector<double>> result;
        for (std::size_t b = 0; b < bones_.size(); ++b) {
            std::vector<double>& list = result.emplace_back(points.size(), 0.0);
            for (std::size_t v = 0; v < points.size(); ++v) {
                const Vec3 q = frame.bone_poses[b].apply_inverse(points[v]);
                if (bones_[b].winding.fast(q, 6.0) > 0.5)
                    list[v] = std::sqrt(bones_[b].surface.closest(q).squared_distance);
            }
        }
        return result;
    }

private:
    struct BoneShape {
        TriangleBvh surface;
        WindingNumber winding;
    };
    std::vector<BoneShape> bones_;
};

/// Vertices, then the centroids of the faces.
Points checked_points(const TriMesh& mesh, const Frame& frame) {
    Points points = *frame.muscle_positions[0];
    for (const Tri& t : mesh.triangles) {
        Vec3 sum = Vec3::Zero();
        for (const int v : t)
            sum += points[static_cast<std::size_t>(v)];
        points.push_back(sum / 3.0);
    }
    return points;
}

SceneRequest gluteus_request(const std::filesystem::path& lhdl) {
    SceneRequest request;
    request.muscles = {lhdl / "gluteus_maximus.vtk"};
    request.bones = {lhdl / "pelvis.obj"};
    request.moving_bones = {lhdl / "femur.vtk"};
    request.hinge = parse_hinge("143.86,243.37,-432.53;1,0,0");
    request.angle_deg = -57.29578;
    request.attachments = {{"gluteus_maximus", lhdl / "gluteus_maximus_attachments.csv"}};
    request.phases = Phases{30, 30, 60}; // of 100, 100, 100: three times as fast
    return request;
}

} // namespace

TEST_CASE("hip muscles through a fast flexion: no vertex and no face centroid enters a bone",
          "[simulation][contact][data][slow]") {
    FASCICLE_NEED_DATA(data);
    const auto muscle = GENERATE(std::string("iliacus"), std::string("gluteus_maximus"));
    const int substeps = GENERATE(3, 10);
    SceneRequest request = gluteus_request(data / "lhdl");
    request.muscles = {data / "lhdl" / (muscle + ".vtk")};
    request.attachments = {{muscle, data / "lhdl" / (muscle + "_attachments.csv")}};
    request.phases = Phases{20, 20, 20};
    LoadedScene loaded = load_scene(request);
    loaded.scene.parameters.set("solver.iterations", substeps);
    Recording recording(std::make_shared<const Scene>(loaded.scene));
    run_simulation(recording, {2}, {});
    REQUIRE(recording.state() == RunState::finished);
    const TriMesh& mesh = *loaded.scene.muscles[0].mesh;
    const InsideOracle oracle(loaded.scene);
    const auto at_rest = oracle.depths(*recording.frame(0), checked_points(mesh, *recording.frame(0)));
    for (int k = 5; k <= 60; k += 5) {
        INFO(muscle << ", " << substeps << " substeps, frame " << k);
        const auto depths = oracle.depths(*recording.frame(k), checked_points(mesh, *recording.frame(k)));
        double deepest = 0;
        for (std::size_t b = 0; b < depths.size(); ++b)
            for (std::size_t i = 0; i < depths[b].size(); ++i)
                if (at_rest[b][i] == 0.0)
                    deepest = std::max(deepest, depths[b][i]);
        CHECK(deepest <= 0.1);
    }
}

TEST_CASE("gluteus maximus through a hip flexion keeps its volume, stays out of the bones and comes back",
          "[simulation][data][slow]") {
    FASCICLE_NEED_DATA(data);
    const LoadedScene loaded = load_scene(gluteus_request(data / "lhdl"));
    Recording recording(std::make_shared<const Scene>(loaded.scene));
    run_simulation(recording, {2}, {});
    REQUIRE(recording.frame_count() == 121);
    REQUIRE(recording.attachments().at(0).size() == 2);
    CHECK(recording.frame(30)->angle_rad == Approx(-1.0).epsilon(1e-6));

    const TriMesh& mesh = *loaded.scene.muscles[0].mesh;
    const double rest_volume = signed_volume(*recording.frame(0)->muscle_positions[0], mesh.triangles);
    MetricsEngine engine(recording, 2);
    const auto row_of = [](const char* key) { return static_cast<std::size_t>(metric_index(key)); };
    const InsideOracle oracle(loaded.scene);
    const auto at_rest = oracle.depths(*recording.frame(0), *recording.frame(0)->muscle_positions[0]);
    for (int k = 0; k <= 120; ++k) {
        INFO("frame " << k);
        const Frame& frame = *recording.frame(k);
        const Points& points = *frame.muscle_positions[0];
        CHECK(signed_volume(points, mesh.triangles) / rest_volume == Approx(1.0).margin(0.01));
        CHECK(frame.report.unresolved == 0);
        CHECK(frame.report.non_finite == 0);
        CHECK(engine.measure(frame)[0][row_of("penetrating_vertices")] == 0);
        if (k % 10 != 0)
            continue;
        int newly_inside = 0;
        const auto depths = oracle.depths(frame, points);
        for (std::size_t b = 0; b < depths.size(); ++b)
            for (std::size_t v = 0; v < points.size(); ++v)
                newly_inside += at_rest[b][v] == 0.0 && depths[b][v] > 0.0 ? 1 : 0;
        CHECK(newly_inside == 0);
    }

    // The muscle has gone somewhere, and is back.
    const auto rms_at = [&](int k) {
        const Points &rest = *recording.frame(0)->muscle_positions[0],
                     &now = *recording.frame(k)->muscle_positions[0];
        double sum = 0;
        for (std::size_t v = 0; v < now.size(); ++v)
            sum += (now[v] - rest[v]).squaredNorm();
        return std::sqrt(sum / static_cast<double>(now.size()));
    };
    CHECK(rms_at(30) > 20.0);
    CHECK(rms_at(120) < 1.0);
}

TEST_CASE("iliacus: half and twice the triangles move volume, mean edge extension and fibre length by less "
          "than 2 %",
          "[simulation][data][slow]") {
    FASCICLE_NEED_DATA(data);
    const std::filesystem::path lhdl = data / "lhdl";
    SceneRequest request = gluteus_request(lhdl);
    request.muscles = {lhdl / "iliacus.vtk"};
    request.attachments = {{"iliacus", lhdl / "iliacus_attachments.csv"}};
    request.phases = Phases{50, 0, 0};
    LoadedScene loaded = load_scene(request);
    loaded.scene.parameters.assign("solver.iterations=3");
    loaded.scene.parameters.assign("contact.grid_mm=2");
    const TriMesh& mesh = *loaded.scene.muscles[0].mesh;
    const TriangleBvh surface(mesh);
    loaded.scene.parameters.assign("fibres.method=kukacka");
    std::vector<double> volumes, extensions, shortenings; // shortening: mean fibre length, flexed over rest
    for (const double factor : {0.5, 1.0, 2.0}) {
        Scene scene = loaded.scene;
        RemeshOptions options;
        options.triangles = static_cast<int>(factor * double(mesh.triangles.size()));
        options.project = [&](const Vec3& p) { return surface.closest(p).point; };
        scene.muscles[0].mesh = std::make_shared<TriMesh>(remesh(mesh, options));
        Recording recording(std::make_shared<Scene>(scene));
        run_simulation(recording, {2}, {});
        REQUIRE(recording.state() == RunState::finished);
        const TriMesh& used = *scene.muscles[0].mesh;
        const Points &rest = *recording.frame(0)->muscle_positions[0],
                     &flexed = *recording.last_frame()->muscle_positions[0];
        const MeshTopology topology(used.vertex_count(), used.triangles);
        double sum = 0;
        for (const Edge& e : topology.edges()) {
            const auto a = static_cast<std::size_t>(e.a), b = static_cast<std::size_t>(e.b);
            sum += (flexed[a] - flexed[b]).norm() / (rest[a] - rest[b]).norm();
        }
        extensions.push_back(sum / double(topology.edges().size()));
        volumes.push_back(signed_volume(flexed, used.triangles) / signed_volume(rest, used.triangles));
        FibreMeasure fibres(scene, 0, recording.fibres().at(0), *recording.frame(0));
        fibres.measure(*recording.frame(0), 1.0);
        const double long_mm = fibres.length_mm().mean;
        fibres.measure(*recording.last_frame(), 1.0);
        shortenings.push_back(fibres.length_mm().mean / long_mm);
        INFO("triangles " << used.triangles.size());
        CHECK(shortenings.back() < 0.97);
        CHECK(shortenings.back() == Approx(shortenings.front()).epsilon(0.02));
        CHECK(volumes.back() == Approx(volumes.front()).epsilon(0.02));
        CHECK(extensions.back() == Approx(extensions.front()).epsilon(0.02));
    }
}
