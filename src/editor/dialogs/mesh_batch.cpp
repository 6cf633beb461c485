#include "editor/dialogs/mesh_batch.hpp"

#include "editor/dialogs/repair_job.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/geometry/volume.hpp"

#include <algorithm>
#include <array>
#include <chrono>

namespace fascicle::editor {

namespace fs = std::filesystem;

namespace {

constexpr int longest_hole = 100; ///< edges; the filler's work grows with the third power

} // namespace

SurfaceFacts facts_of(TriMesh mesh, const MeshReport& report) {
    SurfaceFacts facts;
    facts.report = report;
    facts.box = bounding_box(mesh.positions, mesh.triangles);
    if (report.usable()) {
        facts.volume = report.closed() ? signed_volume(mesh.positions, mesh.triangles) : 0;
        const MeshTopology topology(mesh.vertex_count(), mesh.triangles);
        const auto add = [&](const std::vector<int>& edges, Points& ends) {
            for (const int e : edges) {
                const Edge edge = topology.edges()[static_cast<std::size_t>(e)];
                ends.push_back(mesh.positions[static_cast<std::size_t>(edge.a)]);
                ends.push_back(mesh.positions[static_cast<std::size_t>(edge.b)]);
            }
        };
        if (report.boundary_edges > 0)
            add(topology.boundary_edges(), facts.border);
        if (report.nonmanifold_edges > 0)
            add(topology.nonmanifold_edges(), facts.crowded);
    }
    facts.mesh = std::make_shared<const TriMesh>(std::move(mesh));
    return facts;
}

namespace {

/// Words of a name: letters, in lower case.
std::vector<std::string> words_of(const std::string& name) {
    std::vector<std::string> words(1);
    for (const char c : name) {
        const bool upper = c >= 'A' && c <= 'Z';
        if (upper || (c >= 'a' && c <= 'z'))
            words.back() += upper ? static_cast<char>(c - 'A' + 'a') : c;
        else if (!words.back().empty())
            words.emplace_back();
    }
    return words;
}

template <std::size_t N>
bool has_word(const std::string& name, const std::array<const char*, N>& list) {
    const std::vector<std::string> words = words_of(name);
    return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
        return std::any_of(list.begin(), list.end(), [&](const char* known) { return word == known; });
    });
}

constexpr std::array limb_bones{"femur", "femora", "patella", "tibia",  "fibula", "talus",
                                "foot",  "shank",  "thigh",   "radius", "ulna",   "humerus"};
constexpr std::array trunk_bones{"bone",    "bones",    "pelvis",    "iliac",      "ilium",
                                 "coxa",    "coxae",    "sacrum",    "innominate", "hemipelvis",
                                 "scapula", "clavicle", "sternum",   "rib",        "vertebra",
                                 "skull",   "mandible", "calcaneus", "calcn",      "hipbone"};

} // namespace

bool sounds_like_limb(const std::string& name) {
    return has_word(name, limb_bones);
}

bool sounds_like_bone(const std::string& name) {
    return sounds_like_limb(name) || has_word(name, trunk_bones);
}

ReadMesh read_mesh_with_facts(const fs::path& path) {
    ReadMesh read;
    read.file = read_mesh_file(path);
    read.hints = read_mesh_hints(path);
    if (read.file.mesh.triangles.empty() && read.file.lines.lines.empty())
        throw_error(path.string(), "the file holds points alone", "triangles");
    TriMesh mesh = std::move(read.file.mesh);
    read.file.mesh = {};
    if (read.file.report.boundary_edges > 0) {
        HoleFilling filling = fill_holes(mesh, longest_hole);
        MendedMesh mended = mend(std::move(filling.mesh));
        filling.mesh = {};
        // Only what makes a solid of it is worth offering.
        if (filling.filled > 0 && mended.report.closed() &&
            signed_volume(mended.mesh.positions, mended.mesh.triangles) > 0) {
            read.filled = facts_of(std::move(mended.mesh), mended.report);
            read.filling = std::move(filling);
        }
    }
    const MeshReport& report = read.file.report;
    if (!read.filled && (!report.closed() || report.nonmanifold_edges > 0 || report.nonmanifold_vertices > 0))
        if (RepairResult result = repair(mesh); result.good()) {
            read.repair_steps = result.steps;
            read.repaired = repaired_facts(result);
        }
    read.surface = facts_of(std::move(mesh), report);
    return read;
}

std::string MeshEntry::obstacle() const {
    if (read == nullptr)
        return problem;
    try {
        if (role == actions::MeshRole::bone) {
            require_bone_surface(surface().report, path.filename().string());
            return {};
        }
        const MeshReport& report = surface().report;
        if (report.boundary_edges > 0)
            return "has " + std::to_string(report.holes) + (report.holes == 1 ? " hole" : " holes") +
                   ", so it encloses no volume";
        require_muscle_surface(report, path.filename().string());
        return {};
    } catch (const Error&) {
        return role == actions::MeshRole::bone ? "has fewer than 4 triangles with an area"
                                               : "does not close everywhere, so it encloses no volume";
    }
}

MeshBatch::~MeshBatch() = default; // futures wait for their threads

int MeshBatch::add(const std::vector<fs::path>& files) {
    int last = -1;
    for (const fs::path& file : files) {
        std::error_code error;
        const fs::path full = fs::absolute(file, error).lexically_normal();
        const auto same = [&](const MeshEntry& entry) { return entry.path == full; };
        auto it = std::find_if(entries_.begin(), entries_.end(), same);
        if (it == entries_.end()) {
            MeshEntry entry;
            entry.path = full;
            entry.name = full.stem().string();
            entries_.push_back(std::move(entry));
            it = entries_.end() - 1;
        }
        last = static_cast<int>(it - entries_.begin());
    }
    ++revision_;
    return last;
}

void MeshBatch::add_ready(MeshEntry entry) {
    place(entry);
    entries_.push_back(std::move(entry));
    ++revision_;
}

void MeshBatch::remove(int index) {
    const auto it = entries_.begin() + index;
    if (reading_.valid() && it->path == reading_path_)
        given_up_.push_back(std::move(reading_));
    entries_.erase(it);
    ++revision_;
}

void MeshBatch::clear() {
    if (reading_.valid())
        given_up_.push_back(std::move(reading_));
    entries_.clear();
    ++revision_;
}

bool MeshBatch::reading() const {
    return reading_.valid() || std::any_of(entries_.begin(), entries_.end(), [](const MeshEntry& entry) {
               return entry.read == nullptr && entry.problem.empty();
           });
}

int MeshBatch::done_count() const {
    return static_cast<int>(std::count_if(entries_.begin(), entries_.end(), [](const MeshEntry& entry) {
        return entry.read != nullptr || !entry.problem.empty();
    }));
}

std::vector<fs::path> MeshBatch::poll(const Scene& scene, std::vector<std::string>& problems) {
    const auto finished = [](const std::future<ReadMesh>& f) {
        return f.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    };
    std::erase_if(given_up_, finished);
    std::vector<fs::path> lines;
    if (reading_.valid() && finished(reading_)) {
        const auto it = std::find_if(entries_.begin(), entries_.end(),
                                     [&](const MeshEntry& entry) { return entry.path == reading_path_; });
        ++revision_;
        try {
            it->read = std::make_shared<const ReadMesh>(reading_.get());
            if (it->read->surface.report.triangles == 0) {
                lines.push_back(it->path);
                entries_.erase(it);
            } else {
                guess(*it, scene);
                place(*it);
            }
        } catch (const std::exception& error) {
            it->problem = error.what();
            problems.push_back(it->problem);
        }
    }
    const auto next = std::find_if(entries_.begin(), entries_.end(), [](const MeshEntry& entry) {
        return entry.read == nullptr && entry.problem.empty();
    });
    if (!reading_.valid() && next != entries_.end()) {
        reading_path_ = next->path;
        reading_ = std::async(std::launch::async, [path = next->path] { return read_mesh_with_facts(path); });
    }
    return lines;
}

void MeshBatch::guess(MeshEntry& entry, const Scene& scene) const {
    const SurfaceFacts& surface = entry.read->surface;
    const bool bone_there = !scene.bones.empty() ||
                            std::any_of(entries_.begin(), entries_.end(),
                                        [](const MeshEntry& other) { return sounds_like_bone(other.name); });
    // A closed surface among bones is most likely a muscle, unless its name says otherwise; an open one can only be a bone.
    const bool muscle = surface.report.closed() && bone_there && !sounds_like_bone(entry.name);
    entry.role = muscle ? actions::MeshRole::muscle : actions::MeshRole::bone;
    entry.moving = !muscle && scene.timeline.hinge.has_value() && sounds_like_limb(entry.name);
    const double scene_mm = millimetres_per_unit(scene.unit);
    if (entry.read->hints.millimetres) {
        entry.scale = *entry.read->hints.millimetres / scene_mm;
    } else if (const auto unit = actions::guess_unit(*surface.mesh)) {
        entry.scale = millimetres_per_unit(*unit) / scene_mm;
    }
    entry.scale_guessed = entry.scale != 1;
    if (entry.read->hints.space == MeshSpace::ras)
        entry.axes = AxisMapping::ras_to_lps;
    entry.axes_guessed = entry.axes != AxisMapping::as_is;
}

void MeshBatch::place(MeshEntry& entry) {
    if (entry.read == nullptr)
        return;
    const MeshPtr& mesh = entry.surface().mesh;
    entry.placed = entry.scale == 1 && entry.axes == AxisMapping::as_is
                       ? mesh
                       : std::make_shared<const TriMesh>(mapped(*mesh, entry.axes, entry.scale));
}

void MeshBatch::use_for_all(int index) {
    const MeshEntry& source = entries_[static_cast<std::size_t>(index)];
    for (MeshEntry& entry : entries_) {
        entry.scale = source.scale;
        entry.axes = source.axes;
        place(entry);
    }
    ++revision_;
}

std::vector<actions::NewMesh> MeshBatch::meshes() const {
    std::vector<actions::NewMesh> list;
    for (const MeshEntry& entry : entries_) {
        if (entry.read == nullptr)
            continue;
        const bool as_in_file = entry.placed == entry.read->surface.mesh;
        list.push_back({entry.path, entry.name, entry.role,
                        entry.moving && entry.role == actions::MeshRole::bone, entry.placed,
                        as_in_file ? entry.read->file.hash : std::string(), entry.surface().report});
    }
    return list;
}

int MeshBatch::ready_count() const {
    return static_cast<int>(std::count_if(entries_.begin(), entries_.end(),
                                          [](const MeshEntry& entry) { return entry.read != nullptr; }));
}

bool MeshBatch::ready(std::string& why) const {
    why.clear();
    if (reading())
        why = "Files are still being read.";
    else if (ready_count() == 0)
        why = entries_.empty() ? "Choose a mesh file first." : "None of the files can be read.";
    else
        for (const MeshEntry& entry : entries_)
            if (entry.read != nullptr && !entry.obstacle().empty()) {
                why = entry.name + " cannot be a " +
                      (entry.role == actions::MeshRole::bone ? "bone: it " : "muscle: it ") +
                      entry.obstacle() + ".";
                break;
            }
    return why.empty();
}

} // namespace fascicle::editor
