#pragma once
// Files of a small model and its trial, in a folder of their own.

#include "fascicle/io/files.hpp"
#include "fascicle/io/load_scene.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "support/line_model.hpp"
#include "support/temp_dir.hpp"

namespace fascicle::test {

/// arm.osim: `base` welded to ground, `arm_r` turning about z by elbow_q, a muscle flexor_r of 60 N and 5 cm from base (0.2, 0, 0) to arm
/// (0, 0.05, 0). Geometry/base.obj and ARM.obj: balls of 15 mm about these ends, as the model names them. trial.mot: elbow_q 0.06, 0.12,
/// 0.18 rad.
struct OsimFiles {
    TempDir dir;
    OsimFiles() {
        std::filesystem::create_directories(dir.path() / "Geometry");
        ball("Geometry/base.obj", Vec3(0.2, -0.018, 0));
        ball("Geometry/ARM.obj", Vec3(0, 0.032, 0));
        model();
        trial("time\telbow_q\n0.5\t0.06\n0.52\t0.12\n0.54\t0.18\n");
    }
    std::filesystem::path path(const std::string& name) const { return dir.path() / name; }
    void ball(const std::string& name, const Vec3& centre, double scale = 1) const {
        MeshData data;
        data.mesh = sphere(0.015 * scale, 2, scale * centre);
        write_mesh_file(path(name), data);
    }
    void model(const std::string& base_mesh = "base.obj",
               const std::string& arm_mesh = "C:\\geometry\\arm.obj") const {
        std::string text = arm_osim();
        const auto put = [&](const std::string& before, const std::string& after) {
            const std::size_t at = text.find(before);
            text.replace(at, before.size(), after);
        };
        const auto body = [](const std::string& name, const std::string& mesh) {
            return "<Body name=\"" + name + "\"><attached_geometry><Mesh name=\"m\"><mesh_file>" + mesh +
                   "</mesh_file></Mesh></attached_geometry></Body>";
        };
        put("<Body name=\"base\"/>", body("base", base_mesh));
        put("<Body name=\"arm_r\"/>", body("arm_r", arm_mesh));
        put("</GeometryPath>", "</GeometryPath><max_isometric_force>60</max_isometric_force>"
                               "<optimal_fiber_length>0.05</optimal_fiber_length>");
        write_file(path("arm.osim"), text);
    }
    void trial(const std::string& rows, const std::string& header = "inDegrees=no\n") const {
        write_file(path("trial.mot"), "trial\n" + header + "endheader\n" + rows);
    }
    SceneRequest request() const {
        SceneRequest r;
        r.osim.model = path("arm.osim");
        r.motion = path("trial.mot");
        r.muscles = {"flexor_r"};
        return r;
    }
};

} // namespace fascicle::test
