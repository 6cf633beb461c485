#include "reproduce/work_folder.hpp"

#include "fascicle/base/build_info.hpp"
#include "fascicle/base/content_hash.hpp"
#include "fascicle/io/disk_cache.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/run_writer.hpp"
#include "fascicle/metrics/metric_table.hpp"
#include "fascicle/metrics/muscle_measure.hpp"
#include "fascicle/scene/line_muscles.hpp"
#include "fascicle/simulation/simulation.hpp"

#include <algorithm>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>

namespace fascicle::reproduce {

namespace fs = std::filesystem;

namespace {

const char* const marker = "run.json";

/// Keeps blobs for as long as it lives.
class MemoryStore : public BlobStore {
public:
    std::optional<std::string> find(const std::string& key) override {
        const std::lock_guard lock(mutex_);
        const auto it = blobs_.find(key);
        return it == blobs_.end() ? std::nullopt : std::optional(it->second);
    }
    void keep(const std::string& key, std::string_view bytes) override {
        const std::lock_guard lock(mutex_);
        blobs_[key] = bytes;
    }

private:
    std::mutex mutex_;
    std::map<std::string, std::string> blobs_;
};

void add_text(ContentHash& hash, const std::string& text) {
    hash.add_number(static_cast<std::uint64_t>(text.size()));
    hash.add_bytes(text.data(), text.size());
}

void add_points(ContentHash& hash, const Points& points) {
    hash.add_number(static_cast<std::uint64_t>(points.size()));
    for (const Vec3& p : points)
        hash.add_bytes(p.data(), 3 * sizeof(double));
}

void add_mesh(ContentHash& hash, const TriMesh& mesh) {
    add_points(hash, mesh.positions);
    hash.add_number(static_cast<std::uint64_t>(mesh.triangles.size()));
    hash.add_bytes(mesh.triangles.data(), mesh.triangles.size() * sizeof(Tri));
}

void add_muscle(ContentHash& hash, const Muscle& muscle) {
    add_text(hash, muscle.name);
    add_mesh(hash, *muscle.mesh);
    for (const Attachment& a : muscle.attachments) {
        hash.add_number(static_cast<std::uint64_t>(a.bone) + 1);
        add_text(hash, to_text(a.kind));
        hash.add_number(static_cast<std::uint64_t>(a.vertices.size()));
        hash.add_bytes(a.vertices.data(), a.vertices.size() * sizeof(int));
    }
    for (const AttachmentOutline& o : muscle.outlines) {
        add_text(hash, std::string(to_text(o.kind)) + '|' + o.bone + '|' + o.head + (o.hole ? "|hole" : ""));
        add_points(hash, o.points);
    }
    for (const AttachmentArea& a : muscle.areas) {
        add_text(hash, area_text(a, std::to_string(a.bone)));
        const std::vector<int> vertices = a.vertices.vertices();
        hash.add_bytes(vertices.data(), vertices.size() * sizeof(int));
    }
    for (const std::string& bone : muscle.attach_to)
        add_text(hash, bone);
    add_text(hash, muscle.attach_automatically ? "by nearness" : "as given");
    if (muscle.surface_fibres != nullptr) {
        add_points(hash, muscle.surface_fibres->points);
        for (const std::vector<int>& line : muscle.surface_fibres->lines)
            hash.add_bytes(line.data(), line.size() * sizeof(int));
    }
}

std::string hash_of(const std::string& bytes) {
    ContentHash hash;
    hash.add_bytes(bytes.data(), bytes.size());
    return hash.hex();
}

/// Relative path -> size and hash of every file below, but the marker.
nlohmann::ordered_json listing(const fs::path& folder) {
    std::map<std::string, fs::path> files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file())
            files[entry.path().lexically_relative(folder).generic_string()] = entry.path();
    files.erase(marker);
    nlohmann::ordered_json list = nlohmann::ordered_json::object();
    for (const auto& [name, path] : files) {
        const std::string bytes = read_file(path);
        list[name] = {{"bytes", bytes.size()}, {"hash", hash_of(bytes)}};
    }
    return list;
}

} // namespace

std::string run_key(const RunRequest& request, const std::string& program) {
    const Scene& scene = *request.scene;
    ContentHash hash;
    add_text(hash, program);
    hash.add_number(static_cast<std::uint64_t>(request.every));
    add_text(hash, to_text(scene.unit));
    for (const Bone& bone : scene.bones) {
        add_text(hash, bone.name);
        add_mesh(hash, *bone.mesh);
    }
    for (const Muscle& muscle : scene.muscles)
        add_muscle(hash, muscle);
    const Timeline& timeline = scene.timeline;
    if (timeline.hinge) {
        hash.add_bytes(timeline.hinge->centre.data(), 3 * sizeof(double));
        hash.add_bytes(timeline.hinge->axis.data(), 3 * sizeof(double));
    }
    for (int frame = 0; frame <= timeline.last_frame; ++frame) {
        hash.add_number(timeline.angle_rad(frame));
        for (std::size_t b = 0; b < scene.bones.size(); ++b) {
            const Pose pose = timeline.bone_pose(static_cast<int>(b), frame);
            // Where the pose takes four points tells all of it.
            for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
                const Vec3 q = pose.apply(p);
                hash.add_bytes(q.data(), 3 * sizeof(double));
            }
        }
    }
    for (const ParamRow& row : scene.parameters.table().rows())
        add_text(hash, row.key + '=' + scene.parameters.text(row.key));
    if (scene.line_muscles != nullptr)
        add_text(hash, scene.line_muscles->source.hash);
    for (const std::string& note : request.notes)
        add_text(hash, note);
    return hash.hex();
}

std::string program_identity() {
    std::string text = std::string("fascicle ") + program_version();
    std::error_code error;
    if (const fs::path self = fs::read_symlink("/proc/self/exe", error); !error) {
        try {
            text += ' ' + hash_of(read_file(self));
        } catch (const Error&) {
            // The file was replaced while the program runs; the version is what is left.
        }
    }
    return text;
}

WorkFolder::WorkFolder(fs::path folder, std::string program, int threads)
    : folder_(std::move(folder)), program_(std::move(program)), threads_(threads), cache_(open_cache()) {
    if (cache_ == nullptr)
        cache_ = std::make_shared<MemoryStore>();
}

fs::path WorkFolder::folder_of(const RunRequest& request) const {
    return folder_ / run_key(request, program_);
}

bool WorkFolder::has(const RunRequest& request) const {
    const fs::path folder = folder_of(request);
    std::error_code error;
    if (!fs::is_regular_file(folder / marker, error))
        return false;
    try {
        const auto known = nlohmann::ordered_json::parse(read_file(folder / marker));
        if (known.at("key") != run_key(request, program_))
            return false;
        const nlohmann::ordered_json present = listing(folder); // a user's own pictures of the run among them
        for (const auto& [name, facts] : known.at("files").items())
            if (!present.contains(name) || present.at(name) != facts)
                return false;
        return true;
    } catch (const std::exception&) {
        return false; // unreadable, or not JSON: a damaged run
    }
}

WorkFolder::Made WorkFolder::ensure(const RunRequest& request, const JobControl& control) const {
    const fs::path folder = folder_of(request);
    if (has(request))
        return {folder, true};
    std::error_code ignored;
    fs::remove_all(folder, ignored);
    simulate(request, folder, run_key(request, program_), control);
    return {folder, false};
}

void WorkFolder::remove_outdated() const {
    std::error_code error;
    std::vector<fs::path> outdated;
    for (fs::directory_iterator it(folder_, error), end; !error && it != end; it.increment(error)) {
        const fs::path list = it->path() / marker;
        std::error_code ignored;
        if (!fs::is_regular_file(list, ignored))
            continue;
        try {
            if (nlohmann::json::parse(read_file(list)).at("program") != program_)
                outdated.push_back(it->path());
        } catch (const std::exception&) {
            continue; // not ours to judge; a damaged run is replaced when it is wanted
        }
    }
    for (const fs::path& path : outdated)
        fs::remove_all(path, error);
}

void WorkFolder::simulate(const RunRequest& request, const fs::path& folder, const std::string& key,
                          const JobControl& control) const {
    RunOutputOptions output;
    output.vtp = request.every > 0;
    output.every = std::max(1, request.every);
    output.polylines = output.vtp;
    output.list_exports = false; // the list of files has a hash of the summary
    output.threads = threads_;
    RunWriter writer(folder, request.scene, output);
    SimulationThread simulation(request.scene, {threads_, cache_, request.notes});
    const RecordingPtr recording = simulation.recording();
    std::unique_ptr<MetricsEngine> metrics;
    const int total = request.scene->timeline.last_frame;
    int taken = 0;
    for (bool done = false; !done;) {
        done = simulation.done(); // asked first: what was appended before it is seen below
        for (; taken < recording->frame_count(); ++taken) {
            if (!metrics) {
                metrics = std::make_unique<MetricsEngine>(*recording, threads_);
                writer.set_attachments(recording->attachments());
            }
            const FramePtr frame = recording->frame(taken);
            writer.add_frame(frame, metrics->measure(*frame));
            control.checkpoint("solve", total > 0 ? static_cast<double>(taken) / total : 1.0);
        }
        control.checkpoint("solve", total > 0 && taken > 0 ? (taken - 1.0) / total : 0.0);
        if (!done)
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    if (recording->state() == RunState::failed)
        throw Error(recording->failure());
    std::vector<const FibreSeries*> series;
    for (std::size_t m = 0; m < request.scene->muscles.size(); ++m) {
        const FibreMeasure* fibres = metrics->muscle(static_cast<int>(m)).fibres();
        series.push_back(fibres != nullptr ? &fibres->series() : nullptr);
    }
    writer.finish(*recording, series, [&](const fs::path& place) {
        const nlohmann::ordered_json json{{"key", key}, {"program", program_}, {"files", listing(place)}};
        write_file(place / marker, json.dump(1) + "\n");
    });
}

} // namespace fascicle::reproduce
