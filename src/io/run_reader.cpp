#include "fascicle/io/run_reader.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/base/pose.hpp"
#include "fascicle/io/csv.hpp"
#include "fascicle/io/fibre_files.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "io/formats/vtp.hpp"
#include "io/json_fields.hpp"
#include "io/run_files.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace fascicle {
namespace fs = std::filesystem;
namespace {

/// A vtp file as it stands: not mended, so that vertices and triangles are those that were written.
MeshData read_vtp_file(const RunFiles& files, const fs::path& path) {
    return io::read_vtp(files.read(path), path.string());
}

LengthUnit unit_of(const io::JsonFields& summary) {
    const std::string text = summary.text("unit", "mm");
    if (text != "mm" && text != "m")
        summary.fail("unit", "got '" + text + "'", "mm or m");
    return text == "m" ? LengthUnit::metre : LengthUnit::millimetre;
}

int row_frame(const CsvReader& csv, int column) {
    const double value = csv.number(column);
    if (value < 0 || value != std::floor(value) || value > 1e7)
        csv.fail("frame is " + csv.cell(column), "a whole number from 0");
    return static_cast<int>(value);
}

/// Error unless the table may have so many rows: nothing is made for frames that are only said to be there.
void require_rows(const fs::path& path, std::string_view bytes, std::size_t rows, std::size_t row_bytes) {
    if (rows > bytes.size() / row_bytes + 1)
        throw_error(path.string(), "the table ends too early", std::to_string(rows) + " rows");
}

} // namespace

bool is_run_folder(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path / "summary.json", ignored);
}

RunFiles RunFiles::on_disk() {
    return {[](const fs::path& path) { return read_file(path); },
            [](const fs::path& path) {
                std::error_code ignored;
                return fs::exists(path, ignored);
            }};
}

RunReader::RunReader(fs::path folder, RunFiles files) : folder_(std::move(folder)), files_(std::move(files)) {
    read_summary();
    read_angles();
    read_motion();
    read_rest();
}

void RunReader::read_summary() {
    const std::string file = (folder_ / "summary.json").string();
    const io::Json json = io::parse_json_object(files_.read(file), file);
    const io::JsonFields summary(json, file, "");
    const auto list = json.find("vtp_frames");
    if (list == json.end() || !list->is_array() || list->empty())
        throw_error(folder_.string(), "the run has no frames as files", "a run written with --export vtp");
    for (const io::Json& frame : *list) {
        if (!frame.is_number_integer() || frame.get<long long>() < 0 || frame.get<long long>() > 10'000'000)
            summary.fail("vtp_frames", "not a list of frame numbers", "whole numbers from 0");
        frames_.push_back(frame.get<int>());
    }
    std::sort(frames_.begin(), frames_.end());
    frames_.erase(std::unique(frames_.begin(), frames_.end()), frames_.end());
    if (frames_.front() != 0)
        throw_error(folder_.string(), "the run has no rest frame", "frame 0000");
    auto scene = std::make_shared<Scene>();
    scene->name = summary.text("scene", "scene");
    scene->embedded_name = summary.text("embedded_scene");
    scene->unit = unit_of(summary);
    std::map<std::string, std::string> hashes; // of inputs by path
    if (const auto inputs = json.find("inputs"); inputs != json.end() && inputs->is_array())
        for (const io::Json& input : *inputs)
            if (input.is_object() && input.contains("path") && input["path"].is_string() &&
                input.contains("hash") && input["hash"].is_string())
                hashes[input["path"].get<std::string>()] = input["hash"].get<std::string>();
    const auto source = [&](const io::JsonFields& entry) {
        const std::string path = entry.text("path");
        const auto hash = hashes.find(path);
        return MeshSource{path, hash == hashes.end() ? std::string() : hash->second};
    };
    for (const io::JsonFields& entry : summary.objects("bones")) {
        Bone bone;
        bone.name = entry.text("name");
        bone.source = source(entry);
        MeshData data = read_vtp_file(files_, folder_ / io::bone_file(bone.name));
        bone.mesh = std::make_shared<const TriMesh>(std::move(data.mesh));
        scene->bones.push_back(std::move(bone));
    }
    for (const io::JsonFields& entry : summary.objects("muscles")) {
        Muscle muscle;
        muscle.name = entry.text("name");
        muscle.source = source(entry);
        muscle.attach_automatically = false;
        scene->muscles.push_back(std::move(muscle));
    }
    if (summary.has("hinge")) {
        const io::JsonFields hinge = summary.object("hinge");
        scene->timeline.hinge = Hinge{hinge.vector("centre"), hinge.vector("axis")};
        if (!has_direction(scene->timeline.hinge->axis))
            hinge.fail("axis", "has no direction", "an axis other than 0,0,0");
    }
    if (summary.has("parameters"))
        for (const auto& [key, value] : summary.object("parameters").json().items())
            if (scene->parameters.table().find(key) != nullptr) {
                try {
                    if (value.is_string())
                        scene->parameters.set_text(key, value.get<std::string>());
                    else if (value.is_number())
                        scene->parameters.set(key, value.get<double>());
                } catch (const Error& error) {
                    throw_error(file + ", parameters", error.what());
                }
            }
    scene->timeline.last_frame = frames_.back();
    if (const auto notes = json.find("notes"); notes != json.end() && notes->is_array())
        for (const io::Json& note : *notes)
            if (note.is_string())
                notes_.push_back(note.get<std::string>());
    if (const auto seconds = json.find("prepare_seconds"); seconds != json.end() && seconds->is_number())
        prepare_seconds_ = seconds->get<double>();
    if (const auto threads = json.find("threads"); threads != json.end() && threads->is_number_integer())
        threads_ = static_cast<int>(std::clamp<long long>(threads->get<long long>(), 0, 1'000'000));
    scene_ = std::move(scene);
}

/// Place in frames_ of a frame's number; -1 for one that has no files.
int RunReader::place_of(int frame) const {
    const auto it = std::lower_bound(frames_.begin(), frames_.end(), frame);
    return it != frames_.end() && *it == frame ? static_cast<int>(it - frames_.begin()) : -1;
}

void RunReader::read_motion() {
    const std::size_t count = frames_.size(), bones = scene_->bones.size();
    if (count * std::max<std::size_t>(1, bones) > 20'000'000)
        throw_error(folder_.string(),
                    std::to_string(count) + " frames of " + std::to_string(bones) + " bones",
                    "at most 20 million poses");
    const fs::path path = folder_ / "motion.csv";
    const std::string bytes = files_.read(path);
    require_rows(path, bytes, count * bones, 28); // "0,a,1,0,0,0,0,1,0,0,0,0,1,0" and a line end
    poses_.assign(count, std::vector<Pose>(bones));
    std::vector<char> given(count * bones, 0);
    CsvReader csv(bytes, path.string());
    const int frame_column = csv.column("frame"), bone_column = csv.column("bone");
    int m[3][4];
    bool complete = frame_column >= 0 && bone_column >= 0;
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 4; ++c) {
            m[r][c] = csv.column(std::string{'m', static_cast<char>('0' + r), static_cast<char>('0' + c)});
            complete = complete && m[r][c] >= 0;
        }
    if (!complete)
        csv.fail("a column is missing", "frame,bone,m00,m01,...,m23");
    while (csv.next_row()) {
        const int place = place_of(row_frame(csv, frame_column));
        const int bone = scene_->bone_index(csv.cell(bone_column));
        if (bone < 0)
            csv.fail("bone '" + csv.cell(bone_column) + "' is not in summary.json", "a bone of the run");
        if (place < 0)
            continue;
        const auto k = static_cast<std::size_t>(place), b = static_cast<std::size_t>(bone);
        given[k * bones + b] = 1;
        Pose& pose = poses_[k][b];
        for (int r = 0; r < 3; ++r) {
            for (int c = 0; c < 3; ++c)
                pose.rotation(r, c) = csv.number(m[r][c]);
            pose.translation[r] = csv.number(m[r][3]);
        }
    }
    for (std::size_t i = 0; i < given.size(); ++i)
        if (given[i] == 0)
            throw_error(path.string(),
                        "no row of bone '" + scene_->bones[i % bones].name + "' in frame " +
                            std::to_string(frames_[i / bones]),
                        "a row for every bone and every frame that has files");
}

void RunReader::read_angles() {
    const fs::path path = folder_ / "metrics.csv";
    const std::string bytes = files_.read(path);
    require_rows(path, bytes, frames_.size(), 4); // "0,0" and a line end
    solve_seconds_.assign(frames_.size(), 0.0);
    CsvReader csv(bytes, path.string());
    const int frame_column = csv.column("frame"), angle_column = csv.column("angle_deg"),
              time_column = csv.column("solve_ms"); // of tables that have it
    if (frame_column < 0 || angle_column < 0)
        csv.fail("a column is missing", "frame,muscle,angle_deg,...");
    while (csv.next_row()) {
        const int frame = row_frame(csv, frame_column);
        if (frame > frames_.back())
            continue;
        angles_[frame] = csv.number(angle_column) * (std::numbers::pi / 180.0);
        const int place = place_of(frame);
        if (double ms = 0; place >= 0 && time_column >= 0 && parse_number(csv.cell(time_column), ms))
            solve_seconds_[static_cast<std::size_t>(place)] = ms / 1000.0;
    }
    for (const int frame : frames_)
        if (angles_.count(frame) == 0)
            throw_error(path.string(), "no row of frame " + std::to_string(frame),
                        "a row for every frame that has files");
}

namespace {

/// Fibres of a run's rest, bound to the muscle's surface there; null when there is no such file.
FibreModelPtr read_fibres(const RunFiles& files, const fs::path& path, const TriMesh& surface) {
    if (!files.exists(path))
        return nullptr;
    const MeshData data = read_vtp_file(files, path);
    auto model = std::make_shared<FibreModel>();
    FibreSet& rest = model->rest;
    rest.count = static_cast<int>(data.lines.lines.size());
    rest.segments = rest.count > 0 ? static_cast<int>(data.lines.lines[0].size()) - 1 : 1;
    for (const std::vector<int>& line : data.lines.lines) {
        if (rest.segments < 1 || line.size() != rest.points_per_fibre())
            throw_error(path.string(), "fibres of different numbers of points",
                        "the same number on all of them");
        for (const int p : line)
            rest.points.push_back(data.lines.points.at(static_cast<std::size_t>(p)));
    }
    const MeshTopology topology(surface.vertex_count(), surface.triangles);
    model->carrier = bind_inside(surface, topology, rest.points);
    return model;
}

} // namespace

void RunReader::read_rest() {
    auto scene = std::make_shared<Scene>(*scene_);
    // Which way the joint goes decides the sign of moment arms.
    for (const auto& [frame, angle_rad] : angles_)
        scene->timeline.angles.push_back({static_cast<double>(frame), angle_rad});
    for (Muscle& muscle : scene->muscles) {
        const fs::path path = folder_ / io::frame_file(muscle.name, 0);
        MeshData data = read_vtp_file(files_, path);
        const auto find = [&](const char* name) -> const NamedArray* {
            for (const NamedArray& array : data.point_arrays)
                if (array.name == name && array.components == 1)
                    return &array;
            return nullptr;
        };
        std::vector<Attachment> attachments;
        const NamedArray* kinds = find(io::attachment_array);
        const NamedArray* bones = find(io::attached_to_array);
        for (std::size_t v = 0; kinds != nullptr && bones != nullptr && v < kinds->values.size(); ++v) {
            const double kind = kinds->values[v], bone = bones->values[v];
            if (kind == 0)
                continue;
            if (!(bone >= -1 && bone < static_cast<double>(scene->bones.size())))
                throw_error(path.string(),
                            "vertex " + std::to_string(v) + " is attached to a bone that is not there",
                            "an index of a bone");
            const AttachmentKind which = kind == 1   ? AttachmentKind::origin
                                         : kind == 2 ? AttachmentKind::insertion
                                                     : AttachmentKind::unknown;
            const int index = static_cast<int>(bone);
            auto it = std::find_if(attachments.begin(), attachments.end(),
                                   [&](const Attachment& a) { return a.kind == which && a.bone == index; });
            if (it == attachments.end())
                it = attachments.insert(attachments.end(), {which, index, {}});
            it->vertices.push_back(static_cast<int>(v));
        }
        muscle.attachments = attachments;
        attachments_.push_back(std::move(attachments));
        muscle.mesh = std::make_shared<const TriMesh>(std::move(data.mesh));
        fibres_.push_back(read_fibres(files_, folder_ / fibre_file(muscle.name, 0), *muscle.mesh));
    }
    scene_ = std::move(scene);
}

FramePtr RunReader::read_frame(int frame) const {
    const int place = place_of(frame);
    if (place < 0) {
        const auto nearest = std::min_element(frames_.begin(), frames_.end(), [&](int a, int b) {
            return std::abs(a - frame) < std::abs(b - frame);
        });
        throw_error(folder_.string(), "frame " + std::to_string(frame) + " has no file",
                    "a frame of the run, such as " + std::to_string(*nearest), ErrorKind::usage);
    }
    auto out = std::make_shared<Frame>();
    out->index = frame;
    out->angle_rad = angles_.at(frame);
    out->bone_poses = poses_[static_cast<std::size_t>(place)];
    out->report.solve_seconds = solve_seconds_[static_cast<std::size_t>(place)];
    for (const Muscle& muscle : scene_->muscles) {
        const fs::path path = folder_ / io::frame_file(muscle.name, frame);
        MeshData data = read_vtp_file(files_, path);
        if (data.mesh.positions.size() != muscle.mesh->positions.size())
            throw_error(path.string(), "has " + std::to_string(data.mesh.positions.size()) + " points",
                        std::to_string(muscle.mesh->positions.size()) + ", as at rest");
        out->muscle_positions.push_back(std::make_shared<const Points>(std::move(data.mesh.positions)));
    }
    return out;
}

RecordingPtr RunReader::read_recording(const JobControl& control) const {
    auto recording = std::make_shared<Recording>(scene_);
    recording->set_attachments(attachments_);
    recording->set_fibres(fibres_);
    for (const std::string& note : notes_)
        recording->add_note(note);
    recording->set_prepare_seconds(prepare_seconds_);
    recording->set_threads(threads_);
    for (std::size_t i = 0; i < frames_.size(); ++i) {
        control.checkpoint("read frames", static_cast<double>(i) / static_cast<double>(frames_.size()));
        recording->append(read_frame(frames_[i]));
    }
    recording->finish(RunState::finished);
    return recording;
}

} // namespace fascicle
