#include "fascicle/io/osim_export.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/build_info.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/base/parallel.hpp"
#include "fascicle/base/text.hpp"
#include "fascicle/geometry/bounding_box.hpp"
#include "fascicle/geometry/vertex_normals.hpp"
#include "fascicle/geometry/volume.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "fascicle/io/osim_file.hpp"
#include "fascicle/io/staged_files.hpp"
#include "fascicle/io/storage_write.hpp"
#include "io/osim_export/bake_report.hpp"
#include "io/osim_export/report_files.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

namespace fascicle {
namespace fs = std::filesystem;

namespace io {
namespace {

constexpr std::size_t most_points =
    35'000; ///< of all paths, 34 tags and some 1,700 bytes each: what read_osim takes
constexpr double bone_density = 1900; ///< kg/m3, compact bone; a limb weighs more
constexpr double tendon_share = 0.01;

/// Makes a model step by step; each member function is a step, in their order.
class Exporter {
public:
    Exporter(const Recording& recording, const OsimExportOptions& options, const JobControl& control)
        : recording_(recording), scene_(recording.scene()), options_(options), control_(control) {
        to_model_.turn = axis_matrix(options.axes);
        to_model_.scale = millimetres_per_unit(scene_.unit) / 1000;
    }

    OsimExportReport run(const fs::path& model) {
        check();
        motion_ = bake_motion(recording_, to_model_, options_.coordinate, model_);
        name_files(model);
        bake_bones();
        bake_muscles();
        tell_origins();
        const std::string text = osim_text(model_);
        measure(text);
        write(text);
        return std::move(report_);
    }

private:
    void check() {
        FASCICLE_ASSERT(options_.tolerance_mm > 0 && options_.specific_tension > 0);
        if (recording_.frame_count() == 0)
            throw_error("OpenSim model", "nothing is computed yet", "a run with frames");
        models_ = recording_.fibres();
        std::size_t points = 0;
        for (const FibreModelPtr& m : models_)
            if (m != nullptr)
                points += m->rest.points.size();
        if (points == 0)
            throw_error("OpenSim model", "the run has no fibres",
                        "a run with --set fibres.method=kukacka, chmd or streamlines");
        if (points > most_points)
            throw_error("OpenSim model", "the fibres have " + std::to_string(points) + " points",
                        "at most " + std::to_string(most_points) + ": fewer fibres.count or fibres.segments");
    }

    void name_files(const fs::path& model) {
        const fs::path folder = model.parent_path();
        const std::string stem = model.stem().string();
        model_.name = osim_name(stem, "model");
        report_.model = model;
        report_.motion = folder / (stem + ".mot");
        report_.table = folder / (stem + "_report.csv");
        report_.facts = folder / (stem + "_report.json");
    }

    TriMesh bone_mesh(std::size_t bone) const {
        TriMesh mesh = *scene_.bones[bone].mesh;
        for (Vec3& p : mesh.positions)
            p = motion_.placed[bone].apply(to_model_.point(p));
        return mesh;
    }

    void bake_bones() {
        corners_.resize(model_.bodies.size());
        for (std::size_t b = 0; b < scene_.bones.size(); ++b) {
            const TriMesh mesh = bone_mesh(b);
            set_mass(mesh, bone_density, model_.bodies[b + 1]);
            const BoundingBox box = bounding_box(mesh.positions, mesh.triangles);
            for (int corner = 0; corner < 8; ++corner)
                corners_[b + 1].emplace_back(((corner & 1) != 0 ? box.max : box.min).x(),
                                             ((corner & 2) != 0 ? box.max : box.min).y(),
                                             ((corner & 4) != 0 ? box.max : box.min).z());
        }
    }

    void bake_muscles() {
        FibreBaking baking = fibre_baking(motion_, options_.tolerance_mm / 1000);
        for (const BakedJoint& joint : model_.joints)
            if (joint.coordinate == 0)
                baking.other_body = joint.child;
        OsimNames names;
        for (std::size_t m = 0; m < scene_.muscles.size(); ++m) {
            if (m >= models_.size() || models_[m] == nullptr || models_[m]->rest.count == 0)
                continue;
            const FibreCourses courses(recording_, motion_, to_model_, static_cast<int>(m));
            const std::size_t first_fibre = model_.fibres.size();
            model_.fibres.resize(first_fibre + static_cast<std::size_t>(courses.count()));
            simulated_.resize(model_.fibres.size());
            courses.for_each_part(control_, [&](int first, const std::vector<FibreCourse>& part) {
                parallel_for(options_.threads, part.size(), 1, [&](std::size_t begin, std::size_t end) {
                    for (std::size_t f = begin; f < end; ++f) {
                        const std::size_t i = first_fibre + static_cast<std::size_t>(first) + f;
                        FibrePath path = bake_fibre(baking, part[f]);
                        BakedFibre& fibre = model_.fibres[i];
                        fibre.knots = std::move(path.knots);
                        fibre.points = std::move(path.points);
                        simulated_[i] = std::move(path.simulated);
                        fibre.optimal_length_m = part[f].all_lengths.front(); // for now: at rest
                    }
                });
            });
            set_forces(m, first_fibre);
            name_fibres(m, first_fibre, names);
        }
    }

    /// The same cross-section for all fibres: V / sum of lengths.
    void set_forces(std::size_t muscle, std::size_t first) {
        double lengths = 0;
        for (std::size_t i = first; i < model_.fibres.size(); ++i)
            lengths += model_.fibres[i].optimal_length_m;
        const double volume =
            std::pow(to_model_.scale, 3) * signed_volume(*recording_.frame(0)->muscle_positions[muscle],
                                                         scene_.muscles[muscle].mesh->triangles);
        const double area_cm2 = lengths > 0 ? 1e4 * std::abs(volume) / lengths : 0;
        for (std::size_t i = first; i < model_.fibres.size(); ++i) {
            BakedFibre& fibre = model_.fibres[i];
            // OpenSim wants lengths above 0.
            const double rest = std::max(fibre.optimal_length_m, 1e-4);
            fibre.tendon_length_m = tendon_share * rest;
            fibre.optimal_length_m = rest - fibre.tendon_length_m;
            fibre.max_force_n = options_.specific_tension * area_cm2;
        }
    }

    void name_fibres(std::size_t muscle, std::size_t first, OsimNames& names) {
        const std::size_t count = model_.fibres.size() - first;
        const std::size_t digits = std::max<std::size_t>(2, std::to_string(count).size());
        const std::string stem = osim_name(scene_.muscles[muscle].name, "muscle");
        for (std::size_t i = first; i < model_.fibres.size(); ++i) {
            std::string number = std::to_string(i - first + 1);
            number.insert(0, digits - number.size(), '0');
            BakedFibre& fibre = model_.fibres[i];
            fibre.name = names.unique(stem + "_f" + number);
            OsimFibreReport report;
            report.muscle = scene_.muscles[muscle].name;
            report.fibre = static_cast<int>(i - first);
            report.name = fibre.name;
            report.points = static_cast<int>(fibre.points.size());
            report.moving_points = static_cast<int>(std::count_if(
                fibre.points.begin(), fibre.points.end(), [](const BakedPoint& p) { return p.moving; }));
            report.knots = static_cast<int>(fibre.knots.size());
            report_.fibres.push_back(std::move(report));
        }
    }

    void tell_origins() {
        std::string inputs;
        const auto add = [&](const MeshSource& source) {
            if (!source.path.empty())
                inputs += (inputs.empty() ? " Inputs: " : ", ") + fs::path(source.path).filename().string() +
                          " (" + source.hash + ")";
        };
        for (const Muscle& muscle : scene_.muscles) {
            add(muscle.source);
            for (const MeshSource& source : muscle.outline_files)
                add(source);
            add(muscle.surface_fibres_source);
        }
        for (const Bone& bone : scene_.bones)
            add(bone.source);
        add(scene_.motion_source);
        model_.credits = std::string("Made by fascicle ") + program_version() + " from a simulated run of '" +
                         scene_.name + "': one muscle per fibre." + inputs +
                         (inputs.empty() ? "" : "; in brackets: FNV-1a 64 of the file.");
        model_.publications = "Cervenka and Kohout 2020 (simulation); fibres by the method '" +
                              scene_.parameters.get_choice("fibres.method") +
                              "'; Ravichandiran et al. 2009 (cross-section); specific tension as in "
                              "Rajagopal et al. 2016.";
    }

    void measure(const std::string& text) {
        control_.checkpoint("OpenSim model: report", 0);
        const OsimModel back = read_osim(text, report_.model.string());
        FASCICLE_ASSERT(back.model.muscles.size() == model_.fibres.size());
        const BakedCoordinate& coordinate = model_.coordinates.front();
        report_.coordinate = coordinate.name;
        report_.range_min = coordinate.range_min;
        report_.range_max = coordinate.range_max;
        report_.fitted_frames = static_cast<int>(motion_.fitted.size());
        report_.other_frames = recording_.frame_count() - report_.fitted_frames;
        const BakeReport bake_report(back.model, motion_);
        std::size_t base = 0;
        for (std::size_t m = 0; m < scene_.muscles.size(); ++m) {
            if (m >= models_.size() || models_[m] == nullptr || models_[m]->rest.count == 0)
                continue;
            const FibreCourses courses(recording_, motion_, to_model_, static_cast<int>(m));
            courses.for_each_part(control_, [&](int first, const std::vector<FibreCourse>& part) {
                parallel_for(options_.threads, part.size(), 1, [&](std::size_t begin, std::size_t end) {
                    for (std::size_t f = begin; f < end; ++f) {
                        const std::size_t i = base + static_cast<std::size_t>(first) + f;
                        bake_report.measure(static_cast<int>(i), part[f], simulated_[i], report_.fibres[i]);
                    }
                });
            });
            base += static_cast<std::size_t>(courses.count());
        }
        report_.bone_mm = bake_report.bone_mm(corners_, model_);
        if (report_.bone_mm > 0.1)
            report_.notes.push_back(
                "bones are up to " + number_text(std::ceil(report_.bone_mm * 10) / 10) +
                " mm from the run's: its turns pass a quarter turn about the second axis");
        report_.summary = summary_line(report_);
    }

    std::string motion_text() const {
        StorageTable table;
        table.file = report_.motion.string();
        table.name = model_.name;
        table.in_degrees = model_.coordinates.front().rotational;
        table.columns = {"time"};
        for (const BakedCoordinate& c : model_.coordinates)
            table.columns.push_back(c.name);
        const double frame_time = scene_.parameters.get("solver.frame_time");
        for (int k = 0; k < recording_.frame_count(); ++k) {
            const double value = motion_.values[static_cast<std::size_t>(k)];
            table.values.push_back(recording_.frame(k)->index * frame_time);
            table.values.insert(table.values.end(), model_.coordinates.size(),
                                table.in_degrees ? value * 180 / std::numbers::pi : value);
            table.lines.push_back(static_cast<std::size_t>(k) + 1);
        }
        std::ostringstream out;
        write_storage(out, table);
        return out.str();
    }

    void write(const std::string& text) {
        std::error_code ignored;
        StagedFiles files(fs::absolute(report_.model, ignored).parent_path(), StagedFiles::Use::shared);
        const fs::path& place = files.place();
        for (std::size_t b = 0; b < scene_.bones.size(); ++b) {
            control_.checkpoint("OpenSim model: meshes", double(b) / double(scene_.bones.size()));
            MeshData data;
            data.mesh = bone_mesh(b);
            NamedArray normals{"Normals", 3, {}}; // newer readers of OpenSim's do not open a mesh without
            for (const Vec3& n : vertex_normals(data.mesh.positions, data.mesh.triangles)) {
                const Vec3 unit = n.squaredNorm() > 0 ? n : Vec3(Vec3::UnitZ());
                normals.values.insert(normals.values.end(), {unit.x(), unit.y(), unit.z()});
            }
            data.point_arrays.push_back(std::move(normals));
            write_mesh_file(place / "Geometry" / model_.bodies[b + 1].mesh_file, data);
        }
        write_file(place / report_.motion.filename(), motion_text());
        write_file(place / report_.table.filename(), report_table(report_));
        write_file(place / report_.facts.filename(), report_facts(report_, options_, scene_, model_));
        write_file(place / report_.model.filename(), text);
        files.commit(scene_);
    }

    const Recording& recording_;
    const Scene& scene_;
    const OsimExportOptions& options_;
    const JobControl& control_;
    ToModel to_model_;
    BakedModel model_;
    BakedMotion motion_;
    std::vector<FibreModelPtr> models_;
    std::vector<std::vector<int>> simulated_; ///< per fibre: FibrePath::simulated
    std::vector<Points> corners_;             ///< per body
    OsimExportReport report_;
};

} // namespace
} // namespace io

double OsimExportReport::largest(double OsimFibreReport::*quantity) const {
    double most = std::numeric_limits<double>::quiet_NaN();
    for (const OsimFibreReport& fibre : fibres)
        most = std::fmax(most, fibre.*quantity);
    return most;
}

OsimExportReport export_osim(const fs::path& model, const Recording& recording,
                             const OsimExportOptions& options, const JobControl& control) {
    return io::Exporter(recording, options, control).run(model);
}

std::string reason_against_osim(const Recording& recording) {
    const std::vector<FibreModelPtr> models = recording.fibres();
    if (std::none_of(models.begin(), models.end(), [](const FibreModelPtr& m) { return m != nullptr; }))
        return "the run has no fibres; choose a fibre method in the parameters";
    const Scene& scene = recording.scene();
    for (std::size_t b = 0; b < scene.bones.size(); ++b)
        if (scene.timeline.moves(static_cast<int>(b)))
            return {};
    const int frames = recording.frame_count(); // of a folder: the timeline may tell less
    for (int k = 1; k < frames; ++k)
        for (std::size_t b = 0; b < scene.bones.size(); ++b) {
            const Pose &now = recording.frame(k)->bone_poses[b], &rest = recording.frame(0)->bone_poses[b];
            if (now.rotation != rest.rotation || now.translation != rest.translation)
                return {};
        }
    return "no bone moves: there is nothing to make muscles a function of";
}

} // namespace fascicle
