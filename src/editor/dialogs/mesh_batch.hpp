#pragma once
// Mesh files on their way into the scene: read in the background, what is to become of each, and whether it can.

#include "fascicle/document/actions/mesh_actions.hpp"
#include "fascicle/geometry/axis_mapping.hpp"
#include "fascicle/geometry/bounding_box.hpp"
#include "fascicle/geometry/fill_holes.hpp"
#include "fascicle/geometry/repair/repair.hpp"
#include "fascicle/io/mesh_hints.hpp"

#include <atomic>
#include <future>
#include <optional>

namespace fascicle::editor {

/// A surface with what a person wants to know of it, in the units and axes of its file.
struct SurfaceFacts {
    MeshPtr mesh;
    MeshReport report;
    double volume = 0; ///< cubic units; of a closed surface
    BoundingBox box;
    Points border, crowded; ///< ends of segments: edges with one triangle, with more than two
    Points crossing;        ///< the same: sides of triangles that cross, of the first pairs
};
SurfaceFacts facts_of(TriMesh mesh, const MeshReport& report);

/// What reading made of a file.
struct ReadMesh {
    MeshFile file; ///< without its mesh, which is in `surface`
    MeshHints hints;
    SurfaceFacts surface;
    std::optional<SurfaceFacts> filled; ///< holes closed; nothing when none can be
    HoleFilling filling;                ///< without its mesh
    std::optional<SurfaceFacts>
        repaired; ///< of a mesh with worse than holes, if a repair makes a solid of it
    std::vector<RepairStep> repair_steps;
};
/// Reads, checks, and tries to fill the holes or to repair it. Error as read_mesh_file.
ReadMesh read_mesh_with_facts(const std::filesystem::path& path);

struct MeshEntry {
    std::filesystem::path path;
    std::string name;
    std::shared_ptr<const ReadMesh> read; ///< null while waiting, and when it failed
    std::string problem;                  ///< why it cannot be read
    actions::MeshRole role = actions::MeshRole::bone;
    bool moving = false, fill = false, repair = false;
    double scale = 1; ///< scene units per unit of the file
    AxisMapping axes = AxisMapping::as_is;
    bool scale_guessed = false, axes_guessed = false;
    MeshPtr placed;         ///< in scene units and axes
    std::string stands_for; ///< the bone or muscle of the scene that it replaces in a picture; empty: none

    /// As it will be added: repaired, with its holes filled, or as it is. Only when read.
    const SurfaceFacts& surface() const {
        return repair && read->repaired ? *read->repaired
               : fill && read->filled   ? *read->filled
                                        : read->surface;
    }
    /// Half a sentence why it cannot be what it is to be; empty: it can.
    std::string obstacle() const;
};

class MeshBatch {
public:
    MeshBatch() = default;
    ~MeshBatch();
    MeshBatch(const MeshBatch&) = delete;
    MeshBatch& operator=(const MeshBatch&) = delete;

    /// Index of the last one; a file that is in the list already is only found again.
    int add(const std::vector<std::filesystem::path>& files);
    /// One that was not read from a file: entry.read is there.
    void add_ready(MeshEntry entry);
    void remove(int index);
    /// Gives up what is being read, too.
    void clear();

    /// Takes what has been read and starts the next file; guesses role, unit and axes for `scene`. Files that hold lines alone
    /// are taken out of the list and returned. problems: of files that cannot be read.
    std::vector<std::filesystem::path> poll(const Scene& scene, std::vector<std::string>& problems);
    bool reading() const;
    /// Files read, or failed, of all.
    int done_count() const;

    const std::vector<MeshEntry>& entries() const { return entries_; }
    /// Changes an entry's choices and places it anew.
    template <class Change>
    void change(int index, Change c) {
        MeshEntry& entry = entries_[static_cast<std::size_t>(index)];
        c(entry);
        place(entry);
        ++revision_;
    }
    /// Scale and axes of one entry for all.
    void use_for_all(int index);
    std::uint64_t revision() const { return revision_; } ///< differs after every change

    /// All that was read, in the order of the list. Only when ready().
    std::vector<actions::NewMesh> meshes() const;
    int ready_count() const; ///< entries that were read
    /// Whether there is something to add and all of it can be; else why not.
    bool ready(std::string& why) const;

private:
    static void place(MeshEntry& entry);
    void guess(MeshEntry& entry, const Scene& scene) const;

    std::vector<MeshEntry> entries_;
    std::filesystem::path reading_path_;
    std::future<ReadMesh> reading_;
    std::vector<std::future<ReadMesh>> given_up_; ///< waited for without blocking
    std::uint64_t revision_ = 0;
};

/// Whether a file's name says bone ("right_femur"); and of a bone, whether it is one that turns in the joint next to the trunk.
bool sounds_like_bone(const std::string& name);
bool sounds_like_limb(const std::string& name);

} // namespace fascicle::editor
