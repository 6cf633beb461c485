#include "output/export_writers.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/base/text.hpp"
#include "fascicle/io/animation.hpp"
#include "fascicle/io/fibre_files.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/mesh_stamp.hpp"
#include "fascicle/io/metrics_json.hpp"
#include "fascicle/io/osim_export.hpp"
#include "fascicle/io/output_folder.hpp"
#include "fascicle/io/run_writer.hpp"
#include "fascicle/io/series_file.hpp"
#include "fascicle/io/video_encoder.hpp"
#include "fascicle/metrics/metric_table.hpp"
#include "fascicle/metrics/muscle_measure.hpp"
#include "output/data_export.hpp"
#include "output/staged_files.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <mutex>

namespace fascicle::output {
namespace fs = std::filesystem;

namespace {

std::string numbered(const std::string& name, int frame) {
    char number[24];
    std::snprintf(number, sizeof number, "_%04d.vtp", frame);
    return file_name_for(name) + number;
}

/// Depth inside bones and extension, as simulate's frames have them.
std::vector<std::vector<NamedArray>> point_arrays(const MetricsEngine& metrics, std::size_t muscles) {
    std::vector<std::vector<NamedArray>> arrays;
    for (std::size_t m = 0; m < muscles; ++m) {
        const MuscleMeasure& muscle = metrics.muscle(static_cast<int>(m));
        arrays.push_back({{"depth", 1, muscle.depth_mm_at_vertices()},
                          {"edge_extension", 1, muscle.edge_extension_at_vertices()}});
    }
    return arrays;
}

std::vector<const FibreSeries*> series_of(const MetricsEngine& metrics, std::size_t muscles) {
    std::vector<const FibreSeries*> series;
    for (std::size_t m = 0; m < muscles; ++m) {
        const FibreMeasure* fibres = metrics.muscle(static_cast<int>(m)).fibres();
        series.push_back(fibres != nullptr ? &fibres->series() : nullptr);
    }
    return series;
}

/// A folder as `simulate` leaves it; vtp: with its meshes.
void write_run(const fs::path& folder, const Recording& recording, bool vtp, int threads,
               const JobControl& control) {
    const std::size_t muscles = recording.scene().muscles.size();
    RunOutputOptions output;
    output.vtp = output.polylines = vtp;
    output.threads = threads;
    RunWriter writer(folder, recording.scene_ptr(), output);
    writer.set_attachments(recording.attachments());
    MetricsEngine metrics(recording, threads);
    const int count = recording.frame_count();
    for (int k = 0; k < count; ++k) {
        control.checkpoint("measuring", double(k) / count);
        const FramePtr frame = recording.frame(k);
        const auto values = metrics.measure(*frame);
        writer.add_frame(frame, values,
                         vtp ? point_arrays(metrics, muscles) : std::vector<std::vector<NamedArray>>{});
    }
    writer.finish(recording, series_of(metrics, muscles));
}

} // namespace

/// The table alone, and beside it what was run.
void write_metrics(const ExportRequest& request, const Recording& recording, const JobControl& control) {
    fs::path facts = request.target;
    facts.replace_extension(".json");
    std::error_code ignored;
    StagedFiles files(fs::absolute(request.target, ignored).parent_path(), StagedFiles::Use::shared);
    write_run(files.place() / "run", recording, false, request.threads, control);
    const fs::path run = files.place() / "run";
    std::error_code error;
    fs::rename(run / "summary.json", files.place() / facts.filename(), error);
    if (!error)
        fs::rename(run / "metrics.csv", files.place() / request.target.filename(), error);
    if (error)
        throw_error(request.target.string(), "cannot write: " + error.message());
    fs::remove_all(run, error);
    files.commit(recording.scene());
}

namespace {

std::vector<NamedArray> attachment_arrays(const Recording& recording, std::size_t m) {
    NamedArray kind{
        "attachment", 1,
        std::vector<double>(static_cast<std::size_t>(recording.scene().muscles[m].mesh->vertex_count()))};
    const auto lists = recording.attachments();
    if (m < lists.size())
        for (const Attachment& a : lists[m])
            for (const int v : a.vertices)
                kind.values[static_cast<std::size_t>(v)] = a.kind == AttachmentKind::origin      ? 1
                                                           : a.kind == AttachmentKind::insertion ? 2
                                                                                                 : 3;
    return {kind};
}

TriMesh posed(const TriMesh& mesh, const Pose& pose) {
    TriMesh moved = mesh;
    for (Vec3& p : moved.positions)
        p = pose.apply(p);
    return moved;
}

} // namespace

void write_meshes(const ExportRequest& request, const Recording& recording, const JobControl& control) {
    const Scene& scene = recording.scene();
    const std::vector<int> places = chosen_frames(recording, request);
    const double frame_time = scene.parameters.get("solver.frame_time");
    require_file_names(scene);
    StagedFiles files(request.target);
    MetricsEngine metrics(recording, request.threads);
    std::map<std::string, std::vector<std::pair<double, std::string>>> series;
    std::vector<std::string> names; // muscles, then bones
    for (const Muscle& muscle : scene.muscles)
        names.push_back(muscle.name);
    for (const Bone& bone : scene.bones)
        names.push_back(bone.name);
    names = unique_file_names(names);
    for (std::size_t i = 0; i < places.size(); ++i) {
        control.checkpoint("meshes", double(i) / double(places.size()));
        const FramePtr frame = recording.frame(places[i]);
        metrics.measure(*frame);
        const auto write = [&](const std::string& name, const MeshData& data) {
            const std::string file = numbered(name, frame->index);
            write_stamped_file(files.place() / file, data, stamp_of(recording.scene().unit));
            series[name].emplace_back(frame->index * frame_time, file);
        };
        const auto arrays = point_arrays(metrics, scene.muscles.size());
        for (std::size_t m = 0; m < scene.muscles.size(); ++m) {
            MeshData data;
            data.mesh = {*frame->muscle_positions[m], scene.muscles[m].mesh->triangles};
            data.point_arrays = attachment_arrays(recording, m);
            data.point_arrays.insert(data.point_arrays.end(), arrays[m].begin(), arrays[m].end());
            write(names[m], data);
        }
        for (std::size_t b = 0; b < scene.bones.size(); ++b) {
            MeshData data;
            data.mesh = posed(*scene.bones[b].mesh, frame->bone_poses[b]);
            write(names[scene.muscles.size() + b], data);
        }
    }
    for (const auto& [name, steps] : series)
        write_series_file(files.place() / (file_name_for(name) + ".pvd"), steps);
    files.commit(scene);
}

/// Groups of one OBJ, names as they are but for white space, which ends a name there.
void write_mesh(const ExportRequest& request, const Recording& recording, const JobControl&) {
    check_no_input(request.target, recording.scene());
    const Scene& scene = recording.scene();
    const FramePtr frame = recording.frame(place_of_frame(recording, request.frame));
    AtomicFile file(request.target);
    std::ostream& out = file.stream();
    out << "# " << (scene.unit == LengthUnit::metre ? "1 unit = 1000.000000 mm" : "1 unit = 1.000000 mm")
        << "\n# frame " << frame->index << "\n";
    int offset = 1;
    const auto group = [&](std::string name, const Points& points, const std::vector<Tri>& triangles) {
        for (char& c : name)
            if (static_cast<unsigned char>(c) <= ' ')
                c = '_';
        out << "o " << name << "\n";
        for (const Vec3& p : points)
            out << "v " << number_text(p.x()) << ' ' << number_text(p.y()) << ' ' << number_text(p.z())
                << "\n";
        for (const Tri& t : triangles)
            out << "f " << t[0] + offset << ' ' << t[1] + offset << ' ' << t[2] + offset << "\n";
        offset += static_cast<int>(points.size());
    };
    for (std::size_t m = 0; m < scene.muscles.size(); ++m)
        group(scene.muscles[m].name, *frame->muscle_positions[m], scene.muscles[m].mesh->triangles);
    for (std::size_t b = 0; b < scene.bones.size(); ++b)
        group(scene.bones[b].name, posed(*scene.bones[b].mesh, frame->bone_poses[b]).positions,
              scene.bones[b].mesh->triangles);
    file.commit();
}

/// Moment arms are a matter of the whole run, so all frames are followed, whatever is written.
void write_fibres(const ExportRequest& request, const Recording& recording, const JobControl& control) {
    const Scene& scene = recording.scene();
    const std::vector<FibreModelPtr> models = recording.fibres();
    if (!reason_against_fibres(recording).empty())
        throw_error(request.target.string(), "the run has no fibres", "a run with fibres.method set");
    const std::vector<int> places = chosen_frames(recording, request);
    StagedFiles files(request.target);
    MetricsEngine metrics(recording, request.threads);
    const int count = recording.frame_count();
    for (int k = 0; k < count; ++k) {
        control.checkpoint("fibres", 0.7 * k / count);
        metrics.measure(*recording.frame(k));
    }
    const double frame_time = scene.parameters.get("solver.frame_time");
    std::vector<const FibreSeries*> present;
    std::vector<std::string> names;
    for (const Muscle& muscle : scene.muscles)
        names.push_back(muscle.name);
    names = unique_file_names(names);
    const std::vector<const FibreSeries*> series = series_of(metrics, scene.muscles.size());
    for (std::size_t m = 0; m < series.size(); ++m) {
        if (series[m] == nullptr)
            continue;
        present.push_back(series[m]);
        FibreSet fibres = series[m]->rest();
        std::vector<std::pair<double, std::string>> steps;
        for (std::size_t i = 0; i < places.size(); ++i) {
            control.checkpoint("fibres", 0.7 + 0.3 * double(i) / double(places.size()));
            const FramePtr frame = recording.frame(places[i]);
            models.at(m)->carrier.carry(*frame->muscle_positions[m], fibres.points);
            const std::string file = numbered(names[m] + "_fibres", frame->index);
            write_stamped_file(files.place() / file, fibre_lines(*series[m], frame->index, fibres),
                               stamp_of(recording.scene().unit));
            steps.emplace_back(frame->index * frame_time, file);
        }
        write_series_file(files.place() / (names[m] + "_fibres.pvd"), steps);
    }
    write_fibre_table(files.place() / "fibres.csv", present);
    files.commit(scene);
}

void write_osim(const ExportRequest& request, const Recording& recording, const JobControl& control) {
    OsimExportOptions options;
    options.axes = request.up == 'z' ? AxisMapping::lps_to_opensim : AxisMapping::as_is;
    options.threads = request.threads;
    const OsimExportReport report = export_osim(request.target, recording, options, control);
    if (request.told == nullptr)
        return;
    request.told->push_back(report.model.filename().string() + ": " + report.summary);
    request.told->insert(request.told->end(), report.notes.begin(), report.notes.end());
}

std::string reason_against_fibres(const Recording& recording) {
    const std::vector<FibreModelPtr> models = recording.fibres();
    return std::any_of(models.begin(), models.end(), [](const FibreModelPtr& m) { return m != nullptr; })
               ? ""
               : "the run has no fibres; choose a fibre method in the parameters";
}

std::string reason_against_video() {
    // Looking through $PATH once a second, and when it has changed, is enough: the dialog asks in every frame.
    static std::mutex mutex;
    static std::chrono::steady_clock::time_point looked{};
    static std::string looked_in;
    static bool found = false;
    const std::lock_guard lock(mutex);
    const auto now = std::chrono::steady_clock::now();
    const char* path = std::getenv("PATH");
    const std::string folders = path != nullptr ? path : "";
    if (looked == std::chrono::steady_clock::time_point{} || folders != looked_in ||
        now - looked > std::chrono::seconds(1)) {
        found = !find_video_encoder().empty();
        looked = now;
        looked_in = folders;
    }
    return found ? "" : "no ffmpeg is installed that could make one; a GIF or numbered pictures need none";
}

void write_metrics_json(const ExportRequest& request, const Recording& recording, const JobControl& control) {
    std::error_code ignored;
    StagedFiles files(fs::absolute(request.target, ignored).parent_path(), StagedFiles::Use::shared);
    const fs::path run = files.place() / "run";
    write_run(run, recording, false, request.threads, control);
    write_file(files.place() / request.target.filename(), metrics_json(run));
    fs::remove_all(run);
    files.commit(recording.scene());
}

void write_run_folder(const ExportRequest& request, const Recording& recording, const JobControl& control) {
    write_run(request.target, recording, true, request.threads, control);
}

} // namespace fascicle::output
